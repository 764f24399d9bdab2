// SPDX-License-Identifier: GPL-2.0-or-later
// Axis-aligned boxes of surface elements.  A NURBS element with positive weights lies in the convex hull of
// its control points, so the box of these encloses it (Piegl & Tiller 1997, P4.8).
#pragma once

#include "search/names.h"

namespace search {

/// Axis-aligned box [length].
struct Box {
  Vector3 low, high;
  void inflate(double by) { low.array() -= by, high.array() += by; }
  bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  /// Squared distance of a point from the box, 0 inside [length^2].
  double squared_distance(const Vector3& point) const {
    return (low - point).cwiseMax(point - high).cwiseMax(0.0).squaredNorm();
  }
};

/// Box of the control points of one element.
Box element_box(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points, int element);

}  // namespace search
