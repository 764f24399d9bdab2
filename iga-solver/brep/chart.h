// SPDX-License-Identifier: GPL-2.0-or-later
// Where a face in closed form lies on the NURBS patch that it is taken from, which names its points by other
// parameters.
#pragma once

#include <algorithm>
#include <array>

#include "brep/face.h"
#include "nurbs/multi_patch.h"

namespace brep {

/// One direction: affine, or as many equal arcs, each parametrised as a rational quadratic Bezier arc (Piegl
/// & Tiller 1997, section 7.3), whatever knots have been inserted or degree it was raised to.
class ChartLine {
 public:
  /// Where the patch begins and ends, on the face and on the patch; without arcs it is affine.
  ChartLine(const std::array<double, 2>& on_face, const std::array<double, 2>& on_patch, int arcs);

  bool turns() const { return arcs_ > 0; }
  double to_patch(double on_face) const {  ///< inside its range
    const double s = std::min(std::max((on_face - face_[0]) * part_, 0.0), 1.0);
    return patch_[0] + (arcs_ == 0 ? s : of_arcs(s)) * (patch_[1] - patch_[0]);
  }
  /// Inside, of a line without arcs: on the patch = scale() * on the face + shift(), to round-off.
  double scale() const { return scale_; }
  double shift() const { return shift_; }
  double to_face(double on_patch) const;
  /// to_patch of a length, and of the angle that has this cosine and sine; false if that is outside of the
  /// range.
  bool place_length(double length, double& on_patch) const {
    const double s = (length - face_[0]) * part_;
    on_patch = patch_[0] + s * (patch_[1] - patch_[0]);
    return s >= 0.0 && s <= 1.0;
  }
  bool place_angle(double cos, double sin, double& on_patch) const {
    int arc = 0;
    double nearest = -2.0;
    for (int i = 0; i < arcs_; ++i) {
      const double cos_from_middle = cos * middle_[i][0] + sin * middle_[i][1];
      const bool nearer = cos_from_middle > nearest;  // no branch: nobody could foretell it
      arc = nearer ? i : arc;
      nearest = nearer ? cos_from_middle : nearest;
    }
    const double sin_from_middle = sin * middle_[arc][0] - cos * middle_[arc][1];
    const double t = 0.5 + half_cot_ * sin_from_middle / (1.0 + nearest);
    on_patch = patch_[0] + (arc + t) * arc_on_patch_;
    return t >= 0.0 && t <= 1.0;
  }
  /// The same of many, to the last bit; `inside`: how far they are from both ends of the range, less than 0
  /// outside of it.
  void place_lengths(int count, const double* length, double* on_patch, double* inside) const;
  void place_angles(int count, const double* cos, const double* sin, double* on_patch, double* inside) const;

 private:
  static constexpr int kMostArcs = 4;
  double of_arcs(double s) const;

  std::array<double, 2> face_, patch_;
  double part_;           // of the whole, per unit on the face
  double scale_, shift_;  // without arcs
  int arcs_;
  double middle_[kMostArcs][2] = {};  // of arcs: cosine, sine
  double arc_on_patch_ = 0.0;         // length
  double half_cot_ = 0.0;             // 1/2 cot(a / 4) of their angle a
};

struct Chart {
  ChartLine line[2];
  int side;  ///< +1 or -1: of the face, where dS/dxi x dS/deta of the patch points

  nurbs::Parameter<2> to_patch(const Parameter<2>& xi) const {
    return {line[0].to_patch(xi[0]), line[1].to_patch(xi[1])};
  }
  /// Of a foot on a curved face; false if that is outside of its range.
  bool place(const PolarFoot& foot, nurbs::Parameter<2>& on_patch) const {
    return line[0].place_angle(foot.cos[0], foot.sin[0], on_patch[0]) &&
           (line[1].turns() ? line[1].place_angle(foot.cos[1], foot.sin[1], on_patch[1])
                            : line[1].place_length(foot.length, on_patch[1]));
  }
  Parameter<2> to_face(const nurbs::Parameter<2>& xi) const {
    return {line[0].to_face(xi[0]), line[1].to_face(xi[1])};
  }
};

}  // namespace brep
