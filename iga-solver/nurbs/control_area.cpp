// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/control_area.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "nurbs/assert.h"
#include "nurbs/span_rule.h"

namespace nurbs {
namespace {

double area_jacobian(const RationalBasis<2>& basis, const NodalVectors& X) {
  Vector3 tangent[2] = {Vector3::Zero(), Vector3::Zero()};
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 2; ++d) tangent[d] += basis.dR[d][a] * X.col(basis.control_point[a]);
  return tangent[0].cross(tangent[1]).norm();
}

}  // namespace

Eigen::VectorXd control_point_areas(const Space<2>& space, const NodalVectors& control_points) {
  NURBS_ASSERT(control_points.cols() == space.control_point_count(), control_points.cols(),
               space.control_point_count());
  Eigen::VectorXd area = Eigen::VectorXd::Zero(space.control_point_count());
  RationalBasis<2> basis;
  for (int e = 0; e < space.element_count(); ++e) {
    const Indices<2> indices = space.element_indices(e);
    const QuadratureRule u = span_rule(space.knots(0), indices[0]), v = span_rule(space.knots(1), indices[1]);
    for (std::size_t j = 0; j < v.points.size(); ++j)
      for (std::size_t i = 0; i < u.points.size(); ++i) {
        evaluate_on_element(space, e, {u.points[i], v.points[j]}, 1, basis);
        const double dA = u.weights[i] * v.weights[j] * area_jacobian(basis, control_points);
        for (int a = 0; a < basis.count; ++a) area[basis.control_point[a]] += dA * basis.R[a];
      }
  }
  return area;
}

}  // namespace nurbs
