// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/mesh_compliance.h"

#include <utility>

#include "nurbs/boundary.h"

namespace coupling {

namespace {

std::vector<nurbs::Space<2>> spaces_of(const structure::ReferenceBody& body,
                                       const std::vector<structure::SkinPiece>& skin) {
  std::vector<nurbs::Space<2>> spaces;
  for (const structure::SkinPiece& piece : skin)
    spaces.push_back(nurbs::boundary_surface(body.patches[piece.patch].space, piece.face).space);
  return spaces;
}

}  // namespace

MeshCompliance::MeshCompliance(structure::ReferenceBody body, const std::vector<structure::SkinPiece>& skin)
    : spaces_(spaces_of(body, skin)), tables_(std::move(body), skin) {}

LocalCompliance::Value MeshCompliance::at(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element,
                                          bool with_shear) {
  const nurbs::Space<2>& space = spaces_[foot.patch];
  nurbs::Parameter<2> low, high;
  for (int d = 0; d < 2; ++d) {
    low[d] = space.knots(d).breaks()[element[d]];
    high[d] = space.knots(d).breaks()[element[d] + 1];
  }
  using Table = structure::ComplianceTable;
  const Table& table = tables_.of(foot.patch, space.element_index(element));
  const auto component = [](const Table::Value& value) { return Component{value.c, value.change}; };
  if (!with_shear) return {component(table.at(Table::normal, low, high, foot.xi)), {}};
  const auto all = table.together(low, high, foot.xi);
  return {component(all[Table::normal]),
          {component(all[Table::first]), component(all[Table::second]), component(all[Table::first_second])}};
}

}  // namespace coupling
