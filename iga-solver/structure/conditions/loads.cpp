// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/loads.h"

#include <algorithm>
#include <utility>

#include "nurbs/control_area.h"

namespace structure {

NodalVectors gravity_load(const Body& body, const Vector3& g) { return g * body.row_sum_mass().transpose(); }

namespace {

/// Of the nodes of a face, by their ids, the areas that a traction counts on.
std::vector<std::pair<Id, double>> areas(const nurbs::BoundarySurface& face, const NodalVectors& X) {
  const Eigen::VectorXd area = nurbs::control_point_areas(face.space, X);
  std::vector<std::pair<Id, double>> areas;
  for (Eigen::Index c = 0; c < area.size(); ++c) areas.emplace_back(face.volume_control_point[c], area[c]);
  return areas;
}

}  // namespace

NodalVectors traction_load(const Body& body, const SkinPiece& piece, const Vector3& traction) {
  const nurbs::BoundarySurface face = body.skin(piece);
  const NodalVectors X = body.reference()(Eigen::all, face.volume_control_point);
  NodalVectors f = NodalVectors::Zero(3, body.node_count());
  for (const auto& [node, area] : areas(face, X)) f.col(node) += traction * area;
  return f;
}

void add_traction_load(const nurbs::BoundarySurface& face, const NodalVectors& X, const Vector3& traction,
                       const std::vector<Id>& nodes, NodalVectors& f) {
  std::vector<std::pair<Id, double>> loaded = areas(face, X);
  std::sort(loaded.begin(), loaded.end());
  for (std::size_t column = 0; column < nodes.size(); ++column) {
    const auto found =
        std::lower_bound(loaded.begin(), loaded.end(), std::pair<Id, double>(nodes[column], 0.0));
    if (found != loaded.end() && found->first == nodes[column]) f.col(column) += traction * found->second;
  }
}

}  // namespace structure
