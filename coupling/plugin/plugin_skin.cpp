// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/plugin/plugin_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "nurbs/borders.h"

namespace coupling {

namespace {

template <class... Values>
[[noreturn]] void fail(const char* format, const Values&... values) {
  throw std::invalid_argument(fmt::format(fmt::runtime(format), values...));
}

nurbs::Space<2> read_patch(const StructurePluginPatch& patch, int number) {
  const auto knots = [&](int d) {
    if (!patch.knots[d] || patch.knot_count[d] < 1) fail("patches[{}].knots[{}] is missing", number, d);
    return nurbs::KnotVector(patch.degree[d], {patch.knots[d], patch.knots[d] + patch.knot_count[d]});
  };
  try {
    const std::array<nurbs::KnotVector, 2> both{knots(0), knots(1)};
    std::vector<double> weights;
    if (patch.weights)
      weights.assign(patch.weights, patch.weights + std::ptrdiff_t(both[0].control_point_count()) *
                                                        both[1].control_point_count());
    return nurbs::Space<2>(both, std::move(weights));
  } catch (const std::invalid_argument& problem) {
    fail("patches[{}]: {}", number, problem.what());
  }
}

SurfaceMap read_map(const StructurePluginDescription& is, NodeId control_points) {
  if (!is.first) {
    if (is.node_count != control_points)
      fail("node_count is {}, expected the {} control points, or 'first', 'node' and 'factor'", is.node_count,
           control_points);
    return SurfaceMap::identity(control_points);
  }
  if (!is.node || !is.factor) fail("'first' is given without 'node' or 'factor', expected all three");
  std::vector<Eigen::Triplet<double, NodeId>> entries;
  for (NodeId c = 0; c < control_points; ++c) {
    if (is.first[c + 1] <= is.first[c] || is.first[0] != 0)
      fail("first[{}] is {} after {}, expected rising numbers from 0", c + 1, is.first[c + 1], is.first[c]);
    for (std::int64_t k = is.first[c]; k < is.first[c + 1]; ++k) {
      if (is.node[k] < 0 || is.node[k] >= is.node_count)
        fail("node[{}] is {}, expected 0 to {}", k, is.node[k], is.node_count - 1);
      if (!std::isfinite(is.factor[k])) fail("factor[{}] is not finite", k);
      entries.emplace_back(c, is.node[k], is.factor[k]);
    }
  }
  SurfaceMap::Matrix S(control_points, is.node_count);
  S.setFromTriplets(entries.begin(), entries.end());
  S.makeCompressed();
  return SurfaceMap(S);
}

std::vector<NodeId> read_own(const StructurePluginDescription& is) {
  if (!is.in_parts && is.own_count != is.node_count)
    fail("own_count is {}, expected all {} nodes of a body that is not in parts", is.own_count,
         is.node_count);
  if (is.own_count < 0 || is.own_count > is.node_count)
    fail("own_count is {}, expected 0 to {}", is.own_count, is.node_count);
  std::vector<NodeId> own(is.own_count);
  if (is.own)
    own.assign(is.own, is.own + is.own_count);
  else if (is.own_count == is.node_count)
    std::iota(own.begin(), own.end(), NodeId(0));
  else
    fail("'own' is missing, expected {} ids", is.own_count);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i] < (i == 0 ? 0 : own[i - 1] + 1) || own[i] >= is.node_count)
      fail("own[{}] is {}, expected rising ids from 0 to {}", i, own[i], is.node_count - 1);
  return own;
}

/// Rows of the map along one side of a patch, sorted: which nodes, in which shares.
using Row = std::vector<std::pair<NodeId, double>>;
std::vector<Row> side_rows(const SurfaceMap& map, const nurbs::Space<2>& patch, int first, int side) {
  std::vector<Row> rows;
  for (const int point : nurbs::side_control_points(patch, side)) {
    Row row;
    map.for_each_share(first + point, [&](NodeId node, double share) { row.emplace_back(node, share); });
    rows.push_back(std::move(row));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace

PluginSkin read_skin(const StructurePluginDescription& is) {
  if (is.patch_count < 1 || !is.patches)
    fail("patch_count is {}, expected one patch or more", is.patch_count);
  std::vector<nurbs::Space<2>> patches;
  std::vector<int> outward_sign;
  NodeId control_points = 0;
  for (int p = 0; p < is.patch_count; ++p) {
    patches.push_back(read_patch(is.patches[p], p));
    control_points += patches.back().control_point_count();
    outward_sign.push_back(is.patches[p].outward);
    if (std::abs(outward_sign.back()) > 1)
      fail("patches[{}].outward is {}, expected 1, -1 or 0", p, outward_sign.back());
  }
  PluginSkin skin{
      std::move(patches), std::move(outward_sign), read_map(is, control_points), read_own(is), {}};
  if (is.inverse_mass) skin.inverse_mass = NodalVectors::Map(is.inverse_mass, 3, is.own_count);
  if (skin.inverse_mass.size() > 0 && !(skin.inverse_mass.array() >= 0.0).all())
    fail("inverse_mass has a number that is not >= 0");
  return skin;
}

ContactSurface surface_at(const PluginSkin& skin, const NodalVectors& nodes) {
  NodalVectors points;
  skin.map.to_surface(nodes, points);
  std::vector<nurbs::Surface> patches;
  std::vector<int> first{0};
  for (const nurbs::Space<2>& space : skin.patches) {
    patches.push_back({space, points.middleCols(first.back(), space.control_point_count())});
    first.push_back(first.back() + space.control_point_count());
  }
  const auto same_nodes = [&](int patch, int side, int other_patch, int other_side) {
    return side_rows(skin.map, skin.patches[patch], first[patch], side) ==
           side_rows(skin.map, skin.patches[other_patch], first[other_patch], other_side);
  };
  constexpr double kTolerance = 1e-9;
  nurbs::MultiPatch topology = nurbs::join(patches).topology;
  topology.set_borders(nurbs::find_borders(patches, kTolerance, {}, same_nodes));
  return {std::move(topology), skin.map, skin.outward_sign};
}

}  // namespace coupling
