// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/element_hull.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "nurbs/bezier_element.h"

namespace brep {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Rows: a tangent, the second one, the normal; the axes of space if there is no normal.
Eigen::Matrix3d axes_along(const Vector3& normal, const Vector3& way) {
  const Vector3 z = normal.normalized(), x = (way - way.dot(z) * z).normalized();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  const bool orthogonal = (rows * rows.transpose()).isIdentity(1e-9);
  return orthogonal ? rows : Eigen::Matrix3d::Identity();
}

search::Box box_of(const nurbs::BezierElement& points, const Eigen::Matrix3d& axes) {
  search::Box box{Vector3::Constant(kInfinity), Vector3::Constant(-kInfinity)};
  for (int a = 0; a < points.point_count(); ++a) {
    const Vector3 x = axes * points.bezier_point(a);
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

}  // namespace

ElementHull::ElementHull(const nurbs::Surface& patch, int element, const Vector3& normal) {
  constexpr double kRoundOff = 256.0 * std::numeric_limits<double>::epsilon();  // of Bezier points
  nurbs::BezierElement points;
  points.fetch(patch.space, patch.control_points, element);
  const double leeway = kRoundOff * patch.control_points.cwiseAbs().maxCoeff();
  box_ = box_of(points, Eigen::Matrix3d::Identity());
  box_.inflate(leeway);
  axes_ = axes_along(normal, points.bezier_point(patch.space.degree(0)) - points.bezier_point(0));
  search::Box along = box_of(points, axes_);
  along.inflate(leeway);
  centre_ = axes_.transpose() * (0.5 * (along.low + along.high));
  half_ = 0.5 * (along.high - along.low);
}

}  // namespace brep
