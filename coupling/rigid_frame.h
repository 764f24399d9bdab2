// SPDX-License-Identifier: GPL-2.0-or-later
// Where a rigid body is and how it moves: pose and velocity of its body frame.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "search/box.h"

namespace coupling {

/// Body point X is at x = rotation X + origin; the body's points move with
/// v(x) = velocity + angular_velocity x (x - origin).  A body that is at rest, or whose positions are given
/// in space, has the identity.
struct RigidFrame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< proper orthogonal [-]
  nurbs::Vector3 origin = nurbs::Vector3::Zero();            ///< [length]
  nurbs::Vector3 velocity = nurbs::Vector3::Zero();          ///< of the body point at `origin` [length/time]
  nurbs::Vector3 angular_velocity = nurbs::Vector3::Zero();  ///< [1/time]

  nurbs::Vector3 to_space(const nurbs::Vector3& X) const { return direction_to_space(X) + origin; }
  /// Of points 3 x n.
  nurbs::NodalVectors all_to_space(const nurbs::NodalVectors& X) const {
    nurbs::NodalVectors x(3, X.cols());
    for (Eigen::Index a = 0; a < X.cols(); ++a) x.col(a) = to_space(nurbs::Vector3(X.col(a)));
    return x;
  }
  nurbs::Vector3 to_body(const nurbs::Vector3& x) const { return direction_to_body(x - origin); }
  // In the order in which contact/feet_kernel.cpp adds up: Eigen's own is another one for the last component.
  nurbs::Vector3 direction_to_space(const nurbs::Vector3& X) const {
    return X[0] * rotation.col(0) + X[1] * rotation.col(1) + X[2] * rotation.col(2);
  }
  nurbs::Vector3 direction_to_body(const nurbs::Vector3& x) const {
    return (x[0] * rotation.row(0) + x[1] * rotation.row(1) + x[2] * rotation.row(2)).transpose();
  }
  nurbs::Vector3 velocity_at(const nurbs::Vector3& x) const {
    return velocity + angular_velocity.cross(x - origin);
  }

  /// Largest distance between the places that a body point of the box has in the two frames [length].  The
  /// distance is a convex function of the point, so it is largest at a corner.
  double max_displacement(const RigidFrame& other, const search::Box& body_bounds) const {
    return largest_at_corners(
        body_bounds, [&](const nurbs::Vector3& X) { return (to_space(X) - other.to_space(X)).norm(); });
  }
  /// Largest speed of a body point of the box [length/time].
  double max_speed(const search::Box& body_bounds) const {
    return largest_at_corners(body_bounds,
                              [&](const nurbs::Vector3& X) { return velocity_at(to_space(X)).norm(); });
  }

 private:
  template <class Function>
  static double largest_at_corners(const search::Box& box, Function value_at) {
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      nurbs::Vector3 X;
      for (int d = 0; d < 3; ++d) X[d] = (corner >> d) & 1 ? box.high[d] : box.low[d];
      const double value = value_at(X);
      if (std::isnan(value)) return value;
      largest = std::max(largest, value);
    }
    return largest;
  }
};

}  // namespace coupling
