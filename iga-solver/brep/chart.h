// SPDX-License-Identifier: GPL-2.0-or-later
// Where a face in closed form lies on the NURBS patch that it is taken from, which names its points by other
// parameters.
#pragma once

#include <algorithm>
#include <array>

#include "brep/chart_numbers.h"
#include "brep/face.h"
#include "nurbs/multi_patch.h"

namespace brep {

/// One direction, whatever knots have been inserted or degree it was raised to.
class ChartLine {
 public:
  /// Where the patch begins and ends, on the face and on the patch; without arcs it is affine.
  ChartLine(const std::array<double, 2>& on_face, const std::array<double, 2>& on_patch, int arcs);

  bool turns() const { return arcs_ > 0; }
  double to_patch(double on_face) const {  ///< inside its range
    const double s = std::min(std::max((on_face - face_[0]) * numbers_.part, 0.0), 1.0);
    return patch_[0] + (arcs_ == 0 ? s : of_arcs(s)) * (patch_[1] - patch_[0]);
  }
  /// Inside, of a line without arcs: on the patch = scale() * on the face + shift(), to round-off.
  double scale() const { return scale_; }
  double shift() const { return shift_; }
  double to_face(double on_patch) const;
  /// What round-off may have brought out of the patch's range.
  double inside(double on_patch) const {
    return std::min(std::max(on_patch, std::min(patch_[0], patch_[1])), std::max(patch_[0], patch_[1]));
  }
  /// to_patch of a length, and of the angle that has this cosine and sine; false if that is outside of the
  /// range.
  bool place_length(double length, double& on_patch) const {
    return is_inside(brep::place_length(numbers_, length), on_patch);
  }
  bool place_angle(double cos, double sin, double& on_patch) const {
    return is_inside(brep::place_angle(numbers_, cos, sin), on_patch);
  }
  /// For kernels, which place many.
  const ChartNumbers& numbers() const { return numbers_; }

 private:
  static bool is_inside(const OnChart& at, double& on_patch) {
    on_patch = at.on_patch;
    return at.inside >= 0.0;
  }
  double of_arcs(double s) const;

  std::array<double, 2> face_, patch_;
  ChartNumbers numbers_;
  double scale_, shift_;  // without arcs
  int arcs_;
};

struct Chart {
  ChartLine line[2];
  int side;  ///< +1 or -1: of the face, where dS/dxi x dS/deta of the patch points

  nurbs::Parameter<2> to_patch(const Parameter<2>& xi) const {
    return {line[0].to_patch(xi[0]), line[1].to_patch(xi[1])};
  }
  nurbs::Parameter<2> inside(const nurbs::Parameter<2>& on_patch) const {
    return {line[0].inside(on_patch[0]), line[1].inside(on_patch[1])};
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
