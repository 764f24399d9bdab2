// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/pressure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

#include "nurbs/span_rule.h"

namespace structure {

FollowingPressure::FollowingPressure(const Body& body, const SkinSurface& surface, Field pressure,
                                     TimeFunction factor)
    : pressure_(std::move(pressure)), factor_(std::move(factor)) {
  const auto& [piece, skin, X] = surface;
  functions_ = (skin.space.degree(0) + 1) * (skin.space.degree(1) + 1);
  std::size_t most = 0;
  for (SkinBox& box : body.skin_boxes(piece)) {
    add_points(skin, X, box);
    most = std::max(most, box.control_points.size());
    boxes_.push_back({std::move(box), points_.size()});
  }
  in_box_ = NodalVectors::Zero(3, most);
  share_ = NodalVectors::Zero(3, body.node_count());
}

void FollowingPressure::add_points(const nurbs::BoundarySurface& skin, const NodalVectors& X,
                                   const SkinBox& box) {
  nurbs::RationalBasis<2> basis;
  for (const int e : box.elements) {
    const nurbs::Indices<2> spans = skin.space.element_indices(e);
    const nurbs::QuadratureRule u = nurbs::span_rule(skin.space.knots(0), spans[0]),
                                v = nurbs::span_rule(skin.space.knots(1), spans[1]);
    for (std::size_t j = 0; j < v.points.size(); ++j)
      for (std::size_t i = 0; i < u.points.size(); ++i) {
        nurbs::evaluate_on_element(skin.space, e, {u.points[i], v.points[j]}, 1, basis);
        Point point{Vector3::Zero(), skin.outward_sign * u.weights[i] * v.weights[j], nodes_.size()};
        for (int a = 0; a < basis.count; ++a) {
          const int node = basis.control_point[a];
          point.X += basis.R[a] * X.col(node);
          nodes_.push_back(
              static_cast<int>(std::lower_bound(box.control_points.begin(), box.control_points.end(), node) -
                               box.control_points.begin()));
          values_.push_back({basis.R[a], basis.dR[0][a], basis.dR[1][a]});
        }
        points_.push_back(point);
      }
  }
}

void FollowingPressure::push(const Point& point, double p, const SkinBox& box, const NodalVectors& x) const {
  const int* const nodes = nodes_.data() + point.first;
  const Values* const values = values_.data() + point.first;
  Vector3 du = Vector3::Zero(), dv = Vector3::Zero();
  for (int a = 0; a < functions_; ++a) {
    const auto x_a = x.col(box.read[nodes[a]]);
    du += values[a].dR_du * x_a;
    dv += values[a].dR_dv * x_a;
  }
  const Vector3 force = -p * point.weight * du.cross(dv);
  for (int a = 0; a < functions_; ++a) in_box_.col(nodes[a]) += values[a].R * force;
}

// Box by box, as internal forces: what several boxes add to a node is summed in the same order on any number
// of ranks.
void FollowingPressure::add(double t, const NodalVectors& x, const Halo& halo, NodalVectors& f) const {
  const double factor = value_at(factor_, t);
  share_.setZero();
  std::size_t k = 0;
  for (const Box& box : boxes_) {
    const std::vector<int>& write = box.skin.write;
    in_box_.leftCols(write.size()).setZero();
    for (; k < box.end; ++k) push(points_[k], factor * pressure_(points_[k].X, t)[0], box.skin, x);
    for (std::size_t a = 0; a < write.size(); ++a) share_.col(write[a]) += in_box_.col(a);
  }
  halo.sum_to_owners(share_);
  f += share_;
}

}  // namespace structure
