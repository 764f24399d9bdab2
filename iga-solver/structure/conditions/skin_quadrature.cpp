// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/skin_quadrature.h"

#include <Eigen/Geometry>

#include "nurbs/span_rule.h"
#include "structure/conditions/columns.h"

namespace structure {

// As many points as nurbs::control_point_areas has.
SkinQuadrature::SkinQuadrature(const SkinSurface& surface, const std::vector<Id>& nodes) {
  const Columns columns(nodes);
  const auto& [piece, skin, X] = surface;
  std::vector<std::ptrdiff_t> column_of;
  for (const int node : skin.volume_control_point) column_of.push_back(columns.of(node));
  nurbs::RationalBasis<2> basis;
  for (int e = 0; e < skin.space.element_count(); ++e) {
    const nurbs::Indices<2> spans = skin.space.element_indices(e);
    const nurbs::QuadratureRule u = nurbs::span_rule(skin.space.knots(0), spans[0]),
                                v = nurbs::span_rule(skin.space.knots(1), spans[1]);
    for (std::size_t j = 0; j < v.points.size(); ++j)
      for (std::size_t i = 0; i < u.points.size(); ++i) {
        nurbs::evaluate_on_element(skin.space, e, {u.points[i], v.points[j]}, 1, basis);
        Point point{Vector3::Zero(), columns_.size(), columns_.size()};
        Vector3 tangent[2] = {Vector3::Zero(), Vector3::Zero()};
        for (int a = 0; a < basis.count; ++a) {
          const auto X_a = X.col(basis.control_point[a]);
          point.X += basis.R[a] * X_a;
          for (int d = 0; d < 2; ++d) tangent[d] += basis.dR[d][a] * X_a;
        }
        const double dA = u.weights[i] * v.weights[j] * tangent[0].cross(tangent[1]).norm();
        for (int a = 0; a < basis.count; ++a)
          if (const std::ptrdiff_t column = column_of[basis.control_point[a]]; column >= 0) {
            columns_.push_back(column);
            weights_.push_back(basis.R[a] * dA);
          }
        point.end = columns_.size();
        if (point.end > point.first) points_.push_back(point);
      }
  }
}

}  // namespace structure
