// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/chart.h"

#include <algorithm>
#include <cmath>

#include "nurbs/assert.h"

namespace brep {
namespace {

// The arc that part s in [0, 1] of all is in, and the part of that arc.
struct OnArc {
  int arc;
  double part;
  OnArc(double s, int arcs)
      : arc(std::clamp(static_cast<int>(s * arcs), 0, arcs - 1)), part(s * arcs - arc) {}
};

}  // namespace

ChartLine::ChartLine(const std::array<double, 2>& on_face, const std::array<double, 2>& on_patch, int arcs)
    : face_(on_face),
      patch_(on_patch),
      part_(1.0 / (on_face[1] - on_face[0])),
      scale_(part_ * (on_patch[1] - on_patch[0])),
      shift_(on_patch[0] - on_face[0] * scale_),
      arcs_(arcs) {
  NURBS_ASSERT(arcs <= kMostArcs, arcs);
  if (arcs == 0) return;
  const double each = (face_[1] - face_[0]) / arcs;
  for (int i = 0; i < arcs; ++i) {
    middle_[i][0] = std::cos(face_[0] + (i + 0.5) * each);
    middle_[i][1] = std::sin(face_[0] + (i + 0.5) * each);
  }
  arc_on_patch_ = (patch_[1] - patch_[0]) / arcs;
  half_cot_ = 0.5 / std::tan(0.25 * each);
}

// From the middle of an arc of angle a, tan(angle / 2) = (2 t - 1) tan(a / 4).
double ChartLine::of_arcs(double s) const {
  const OnArc at(s, arcs_);
  const double quarter = 0.25 * std::abs(face_[1] - face_[0]) / arcs_;
  const double t = 0.5 + 0.5 * std::tan((2.0 * at.part - 1.0) * quarter) / std::tan(quarter);
  return (at.arc + t) / arcs_;
}

void ChartLine::place_lengths(int count, const double* length, double* on_patch, double* inside) const {
  const double low = face_[0], part = part_, first = patch_[0], whole = patch_[1] - patch_[0];
  for (int k = 0; k < count; ++k) {
    const double s = (length[k] - low) * part;
    on_patch[k] = first + s * whole;
    inside[k] = std::min(s, 1.0 - s);
  }
}

// All arcs there may be: the middle of those that there are not is no nearer than the first.
void ChartLine::place_angles(int count, const double* cos, const double* sin, double* on_patch,
                             double* inside) const {
  static_assert(kMostArcs == 4, "as many as are looked at");
  const auto middle = [this](int i) { return std::array<double, 2>{middle_[i][0], middle_[i][1]}; };
  const std::array<double, 2> m0 = middle(0), m1 = middle(arcs_ > 1 ? 1 : 0), m2 = middle(arcs_ > 2 ? 2 : 0),
                              m3 = middle(arcs_ > 3 ? 3 : 0);
  const double half_cot = half_cot_, first = patch_[0], each = arc_on_patch_;
  for (int k = 0; k < count; ++k) {
    const double x = cos[k], y = sin[k];
    double nearest = x * m0[0] + y * m0[1], across = y * m0[0] - x * m0[1], arc = 0.0;
    const auto look_at = [&](const std::array<double, 2>& m, double number) {
      const double cos_from_middle = x * m[0] + y * m[1], sin_from_middle = y * m[0] - x * m[1];
      const bool nearer = cos_from_middle > nearest;
      arc = nearer ? number : arc;
      across = nearer ? sin_from_middle : across;
      nearest = nearer ? cos_from_middle : nearest;
    };
    look_at(m1, 1.0);
    look_at(m2, 2.0);
    look_at(m3, 3.0);
    const double t = 0.5 + half_cot * across / (1.0 + nearest);
    on_patch[k] = first + (arc + t) * each;
    inside[k] = std::min(t, 1.0 - t);
  }
}

double ChartLine::to_face(double on_patch) const {
  double s = (on_patch - patch_[0]) / (patch_[1] - patch_[0]);
  if (arcs_ > 0) {
    const OnArc at(s, arcs_);
    const double quarter = 0.25 * std::abs(face_[1] - face_[0]) / arcs_;
    s = (at.arc + 0.5 + 0.5 * std::atan((2.0 * at.part - 1.0) * std::tan(quarter)) / quarter) / arcs_;
  }
  return face_[0] + s * (face_[1] - face_[0]);
}

}  // namespace brep
