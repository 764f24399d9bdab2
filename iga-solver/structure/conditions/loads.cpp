// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/loads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

#include "nurbs/control_area.h"
#include "nurbs/span_rule.h"

namespace structure {

NodalVectors gravity_load(const Body& body, const Vector3& g) { return g * body.row_sum_mass().transpose(); }

std::vector<std::pair<Id, double>> skin_areas(const SkinSurface& skin) {
  const Eigen::VectorXd area = nurbs::control_point_areas(skin.face.space, skin.X);
  std::vector<std::pair<Id, double>> areas;
  for (Eigen::Index c = 0; c < area.size(); ++c)
    areas.emplace_back(skin.face.volume_control_point[c], area[c]);
  return areas;
}

NodalVectors traction_load(const Body& body, const SkinPiece& piece, const Vector3& traction) {
  NodalVectors f = NodalVectors::Zero(3, body.node_count());
  for (const auto& [node, area] : skin_areas(skin_surface(body, piece))) f.col(node) += traction * area;
  return f;
}

void add_traction_load(const SkinSurface& skin, const Vector3& traction, const Columns& columns,
                       NodalVectors& f) {
  for (const auto& [node, area] : skin_areas(skin))
    if (const std::ptrdiff_t column = columns.of(node); column >= 0) f.col(column) += traction * area;
}

void add_point_load(const Probe& point, const Vector3& force, const Columns& columns, NodalVectors& f) {
  for (std::size_t a = 0; a < point.nodes.size(); ++a)
    if (const std::ptrdiff_t column = columns.of(point.nodes[a]); column >= 0)
      f.col(column) += point.weights[a] * force;
}

namespace {

/// What holds at a quadrature point of a patch, added to the nodes of a part.
class PatchPoint {
 public:
  PatchPoint(const nurbs::Volume& patch, const std::vector<Id>& ids, const Columns& columns) : patch_(patch) {
    for (const Id id : ids) columns_.push_back(columns.of(id));
  }
  /// Whether the part holds a node of the element.
  bool concerns(int element) {
    nodes_.resize(patch_.space.functions_per_element());
    patch_.space.element_control_points(element, nodes_.data());
    return std::any_of(nodes_.begin(), nodes_.end(), [&](int node) { return columns_[node] >= 0; });
  }
  void evaluate(int element, const nurbs::Parameter<3>& xi) {
    nurbs::evaluate_on_element(patch_.space, element, xi, 1, basis_);
  }
  Vector3 place() const { return nurbs::interpolate(basis_, patch_.control_points); }
  Vector3 tangent(int direction) const {
    Vector3 sum = Vector3::Zero();
    for (int a = 0; a < basis_.count; ++a)
      sum += basis_.dR[direction][a] * patch_.control_points.col(basis_.control_point[a]);
    return sum;
  }
  void add(const Vector3& force, NodalVectors& f) const {
    for (int a = 0; a < basis_.count; ++a)
      if (const std::ptrdiff_t column = columns_[basis_.control_point[a]]; column >= 0)
        f.col(column) += basis_.R[a] * force;
  }

 private:
  const nurbs::Volume& patch_;
  std::vector<std::ptrdiff_t> columns_;  // of control points
  std::vector<int> nodes_;
  nurbs::RationalBasis<3> basis_;
};

}  // namespace

void add_line_load(const nurbs::Volume& patch, const std::vector<Id>& ids,
                   const std::array<nurbs::Face, 2>& edge, const Field& load, const Columns& columns,
                   NodalVectors& f) {
  const int across[2] = {static_cast<int>(edge[0]) / 2, static_cast<int>(edge[1]) / 2};
  const int along = 3 - across[0] - across[1];
  nurbs::Indices<3> spans{};
  nurbs::Parameter<3> xi{};
  for (int k = 0; k < 2; ++k) {
    const nurbs::KnotVector& knots = patch.space.knots(across[k]);
    const bool plus = static_cast<int>(edge[k]) % 2 == 1;
    spans[across[k]] = plus ? knots.element_count() - 1 : 0;
    xi[across[k]] = plus ? knots.back() : knots.front();
  }
  PatchPoint point(patch, ids, columns);
  for (int span = 0; span < patch.space.knots(along).element_count(); ++span) {
    spans[along] = span;
    const int element = patch.space.element_index(spans);
    if (!point.concerns(element)) continue;
    const nurbs::QuadratureRule rule = nurbs::span_rule(patch.space.knots(along), span);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      xi[along] = rule.points[q];
      point.evaluate(element, xi);
      point.add(rule.weights[q] * point.tangent(along).norm() * load(point.place(), 0.0), f);
    }
  }
}

void add_body_force(const nurbs::Volume& patch, const std::vector<Id>& ids, const Field& force,
                    const Columns& columns, NodalVectors& f) {
  PatchPoint point(patch, ids, columns);
  for (int element = 0; element < patch.space.element_count(); ++element) {
    if (!point.concerns(element)) continue;
    const nurbs::Indices<3> spans = patch.space.element_indices(element);
    nurbs::QuadratureRule rule[3];
    for (int d = 0; d < 3; ++d) rule[d] = nurbs::span_rule(patch.space.knots(d), spans[d]);
    for (std::size_t k = 0; k < rule[2].points.size(); ++k)
      for (std::size_t j = 0; j < rule[1].points.size(); ++j)
        for (std::size_t i = 0; i < rule[0].points.size(); ++i) {
          point.evaluate(element, {rule[0].points[i], rule[1].points[j], rule[2].points[k]});
          const double dV = rule[0].weights[i] * rule[1].weights[j] * rule[2].weights[k] *
                            point.tangent(0).cross(point.tangent(1)).dot(point.tangent(2));
          point.add(dV * force(point.place(), 0.0), f);
        }
  }
}

}  // namespace structure
