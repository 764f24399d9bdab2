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
      scale_(1.0 / (on_face[1] - on_face[0]) * (on_patch[1] - on_patch[0])),
      shift_(on_patch[0] - on_face[0] * scale_),
      arcs_(arcs) {
  constexpr int kMost = ChartNumbers::kMostArcs;
  NURBS_ASSERT(arcs <= kMost, arcs);
  numbers_.low = face_[0], numbers_.part = 1.0 / (face_[1] - face_[0]);
  numbers_.first = patch_[0], numbers_.whole = patch_[1] - patch_[0];
  if (arcs == 0) return;
  const double each = (face_[1] - face_[0]) / arcs;
  for (int i = 0; i < kMost; ++i) {
    const double middle = face_[0] + ((i < arcs ? i : 0) + 0.5) * each;
    numbers_.middle[i][0] = std::cos(middle), numbers_.middle[i][1] = std::sin(middle);
  }
  numbers_.each = numbers_.whole / arcs;
  numbers_.half_cot = 0.5 / std::tan(0.25 * each);
}

// From the middle of an arc of angle a, tan(angle / 2) = (2 t - 1) tan(a / 4).
double ChartLine::of_arcs(double s) const {
  const OnArc at(s, arcs_);
  const double quarter = 0.25 * std::abs(face_[1] - face_[0]) / arcs_;
  const double t = 0.5 + 0.5 * std::tan((2.0 * at.part - 1.0) * quarter) / std::tan(quarter);
  return (at.arc + t) / arcs_;
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
