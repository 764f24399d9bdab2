// SPDX-License-Identifier: GPL-2.0-or-later
// One element of a surface as a rational Bezier patch: fetched once, then evaluated at many points.
// Source: Piegl & Tiller (1997), sections 1.3-1.4 and 5.3.
#pragma once

#include "nurbs/patch.h"

namespace nurbs {

class BezierElement {
 public:
  /// Fetches an element of the surface with these control points (3 x n).
  void fetch(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points, int element);

  /// Its Bezier points: it lies in their convex hull, which is far smaller than that of the control points
  /// that an element of a high degree shares with its neighbours.
  int point_count() const { return (degree_[0] + 1) * (degree_[1] + 1); }
  Vector3 bezier_point(int a) const { return bezier_.col(a).head<3>() / bezier_(3, a); }

  /// The closed element; a knot between two belongs to both.
  bool holds(const Parameter<2>& xi) const;

  struct PointAndTangent {
    Vector3 S;    ///< [length]
    Vector3 S_j;  ///< d S / d xi_j [length / parameter]
  };
  /// At xi, with the derivative in direction j.  Outside the element its polynomials go on.
  PointAndTangent evaluate(const Parameter<2>& xi, int j) const;

 private:
  static constexpr int kMaxPoints = power(kMaxDegree + 1, 2);

  int degree_[2];
  double begin_[2], end_[2], width_[2];                    // of the parameters
  Eigen::Matrix<double, 4, kMaxPoints> bezier_, scratch_;  // columns (w P, w), direction 0 fastest
};

}  // namespace nurbs
