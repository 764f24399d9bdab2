// SPDX-License-Identifier: GPL-2.0-or-later
// What encloses an element of a patch: boxes around its Bezier points, one along the axes of space, one along
// the element.  The control points that an element of a high degree shares with its neighbours reach over
// the whole patch; Bezier points are its own.  Source: Piegl & Tiller (1997), P4.8 and section 5.3.
#pragma once

#include "brep/names.h"
#include "nurbs/patch.h"
#include "search/box.h"

namespace brep {

class ElementHull {
 public:
  /// `normal`: one of the element, about which it is thin; of any length, zero or not a number: none.
  ElementHull(const nurbs::Surface& patch, int element, const Vector3& normal);

  /// Along the axes of space.
  const search::Box& box() const { return box_; }
  /// Of a ball around it.
  const Vector3& centre() const { return centre_; }
  double radius() const { return half_.norm(); }
  /// Of a point, not more than that from the element [length^2].
  double squared_distance(const Vector3& d) const {
    return ((axes_ * (d - centre_)).cwiseAbs() - half_).cwiseMax(0.0).squaredNorm();
  }
  /// Of the element from centre(), in a direction of length 1, to either side.
  double extent(const Vector3& direction) const { return (axes_ * direction).cwiseAbs().dot(half_); }

 private:
  search::Box box_;
  Vector3 centre_, half_;  // of the box along the element; the latter along its axes
  Eigen::Matrix3d axes_;   // rows
};

}  // namespace brep
