// SPDX-License-Identifier: GPL-2.0-or-later
#include "held_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <variant>
#include <vector>

#include "io/boundary_keys.h"
#include "io/loose_patches.h"
#include "structure/analysis/rigid_motions.h"

namespace app {

namespace {

/// Of the nodes of a piece, which rise.
std::size_t free_motions(const io::ModelFile& model, const std::vector<structure::Id>& nodes) {
  nurbs::NodalVectors X(3, nodes.size());
  for (std::size_t column = 0; column < nodes.size(); ++column) {
    const auto place = model.nodes.place(nodes[column]);
    X.col(static_cast<Eigen::Index>(column)) =
        model.volume(place.patch).control_points.col(place.control_point);
  }
  return structure::free_rigid_motions(X, io::supports_of(model.boundary).on(nodes),
                                       io::springs_of(model.boundary, model.geometry, model.nodes, nodes))
      .size();
}

}  // namespace

FreeMotions free_motions(const io::ModelFile& model) {
  const io::Pieces pieces = io::pieces_of(model.nodes);
  std::vector<std::vector<structure::Id>> nodes(pieces.count);
  for (structure::Id node = 0; node < model.nodes.node_count(); ++node)
    nodes[pieces.of_patch[model.nodes.place(node).patch]].push_back(node);
  for (int piece = 0; piece < pieces.count; ++piece)
    if (const std::size_t count = free_motions(model, nodes[piece]); count > 0) {
      const auto first = std::find(pieces.of_patch.begin(), pieces.of_patch.end(), piece);
      return {count, pieces.count == 1
                         ? "it"
                         : fmt::format("patch {} and what is welded to it", first - pieces.of_patch.begin())};
    }
  return {};
}

void expect_held_pieces(const io::ModelFile& model) {
  if (std::holds_alternative<io::ModeAnalysis>(*model.analysis) || io::pieces_of(model.nodes).count == 1)
    return;
  if (const FreeMotions free = free_motions(model); free.count > 0)
    throw std::runtime_error(
        fmt::format("{}: {}: 'boundary' leaves {} free in {} of its 6 rigid motions, expected none: hold it, "
                    "or let whole faces of one mesh meet those of what is held",
                    model.file, io::analysis_word(*model.analysis), free.whose, free.count));
}

}  // namespace app
