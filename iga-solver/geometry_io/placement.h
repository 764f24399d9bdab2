// SPDX-License-Identifier: GPL-2.0-or-later
// Shapes scaled, turned and moved as a whole: what a file says of its patches, and a deck of a rigid wall.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "nurbs/types.h"

namespace geometry_io {

/// x -> A x + b [length]; `b * a` is a, then b.
using Placement = Eigen::Transform<double, 3, Eigen::Affine>;

/// About the origin of the coordinates; factors > 0.
inline Placement scaling(const nurbs::Vector3& factors) { return Placement(Eigen::Scaling(factors)); }

/// By the right hand; the axis is not zero.
inline Placement turning(const nurbs::Vector3& axis, double degrees,
                         const nurbs::Vector3& origin = nurbs::Vector3::Zero()) {
  const double angle = degrees * std::acos(-1.0) / 180.0;
  return Eigen::Translation3d(origin) * Eigen::AngleAxisd(angle, axis.stableNormalized()) *
         Eigen::Translation3d(-origin);
}

inline Placement shifting(const nurbs::Vector3& way) { return Placement(Eigen::Translation3d(way)); }

/// Of control points, or corners of triangles.
inline void place(nurbs::NodalVectors& points, const Placement& placement) {
  points = (placement * points).eval();
}

}  // namespace geometry_io
