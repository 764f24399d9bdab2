// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/loads.h"

#include <Eigen/Geometry>

#include "structure/gauss_legendre.h"

namespace structure {

namespace {

std::array<QuadratureRule, 2> element_rules(const nurbs::Space<2>& space, int element) {
  const std::array<int, 2> span = space.element_indices(element);
  std::array<QuadratureRule, 2> rule;
  for (int d = 0; d < 2; ++d) {
    const std::vector<double>& breaks = space.knots(d).breaks();
    rule[d] = gauss_legendre(space.degree(d) + 1, breaks[span[d]], breaks[span[d] + 1]);
  }
  return rule;
}

/// |dX/du x dX/dv| on a face.
double area_jacobian(const nurbs::RationalBasis<2>& basis, const nurbs::BoundarySurface& boundary,
                     const NodalVectors& X) {
  Vector3 tangent_u = Vector3::Zero(), tangent_v = Vector3::Zero();
  for (int a = 0; a < basis.count; ++a) {
    const int node = boundary.volume_control_point[basis.control_point[a]];
    tangent_u += basis.dR[0][a] * X.col(node);
    tangent_v += basis.dR[1][a] * X.col(node);
  }
  return tangent_u.cross(tangent_v).norm();
}

}  // namespace

NodalVectors gravity_load(const Solid& solid, const Vector3& g) {
  return g * solid.row_sum_mass().transpose();
}

NodalVectors traction_load(const nurbs::Volume& patch, nurbs::Face face, const Vector3& traction) {
  const nurbs::BoundarySurface boundary = nurbs::boundary_surface(patch.space, face);
  NodalVectors f = NodalVectors::Zero(3, patch.control_points.cols());
  nurbs::RationalBasis<2> basis;
  for (int e = 0; e < boundary.space.element_count(); ++e) {
    const std::array<QuadratureRule, 2> rule = element_rules(boundary.space, e);
    for (std::size_t j = 0; j < rule[1].points.size(); ++j)
      for (std::size_t i = 0; i < rule[0].points.size(); ++i) {
        nurbs::evaluate_on_element(boundary.space, e, {rule[0].points[i], rule[1].points[j]}, 1, basis);
        const double dA =
            rule[0].weights[i] * rule[1].weights[j] * area_jacobian(basis, boundary, patch.control_points);
        for (int a = 0; a < basis.count; ++a)
          f.col(boundary.volume_control_point[basis.control_point[a]]) += dA * basis.R[a] * traction;
      }
  }
  return f;
}

}  // namespace structure
