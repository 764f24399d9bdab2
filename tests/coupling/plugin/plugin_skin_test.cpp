// SPDX-License-Identifier: GPL-2.0-or-later
// The skin that a plug-in describes: its map, its welds, and what is refused; bytes of its state as numbers.
#include "coupling/plugin/plugin_skin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "coupling/plugin/opaque_bytes.h"

namespace {

using coupling::NodalVectors;
using coupling::read_skin;
using coupling::surface_at;
using testing::HasSubstr;

/// Two bilinear squares side by side along x, on six nodes, of which the two in the middle are common: the
/// second row of the map takes halves.
struct TwoSquares {
  const double knots[4] = {0, 0, 1, 1};
  const double weights[4] = {1, 2, 1, 1};
  StructurePluginPatch patches[2] = {{{1, 1}, {4, 4}, {knots, knots}, nullptr, 1},
                                     {{1, 1}, {4, 4}, {knots, knots}, weights, -1}};
  std::int64_t first[9] = {0, 1, 2, 3, 4, 5, 7, 8, 9};
  std::int64_t node[9] = {0, 1, 3, 4, 1, 2, 2, 4, 5};
  double factor[9] = {1, 1, 1, 1, 1, 0.25, 0.75, 1, 1};
  std::int64_t own[6] = {0, 1, 2, 3, 4, 5};

  StructurePluginDescription description() const {
    StructurePluginDescription is{};
    is.size = sizeof(is);
    is.units = "si";
    is.patch_count = 2;
    is.patches = patches;
    is.node_count = 6;
    is.first = first;
    is.node = node;
    is.factor = factor;
    is.own_count = 6;
    return is;
  }
};

NodalVectors grid() {
  NodalVectors x(3, 6);
  x << 0, 1, 2, 0, 1, 2, /**/ 0, 0, 0, 1, 1, 1, /**/ 0, 0, 0, 0, 0, 0;
  return x;
}

TEST(PluginSkin, ControlPointsHangOnNodesInShares) {
  const coupling::PluginSkin skin = read_skin(TwoSquares().description());
  EXPECT_EQ(skin.patches[1].weight(1), 2.0);
  EXPECT_THAT(skin.outward_sign, testing::ElementsAre(1, -1));
  EXPECT_EQ(skin.own.size(), 6u);
  NodalVectors points, x = grid();
  x(2, 2) = 4.0;
  skin.map.to_surface(x, points);
  EXPECT_EQ(points.col(4), x.col(1));
  EXPECT_EQ(points.col(5), 0.25 * x.col(2) + 0.75 * x.col(2));
  NodalVectors f = NodalVectors::Zero(3, 6);
  skin.map.add_to_nodes(NodalVectors::Ones(3, 8), f);
  EXPECT_EQ(f(0, 1), 2.0);
  EXPECT_EQ(f.sum(), 24.0);
}

TEST(PluginSkin, EdgesOnTheSameNodesAreWelded) {
  const coupling::ContactSurface welded = surface_at(read_skin(TwoSquares().description()), grid());
  EXPECT_EQ(welded.topology.patch_count(), 2);
  EXPECT_EQ(welded.topology.border(0, 1).patch, 1);

  // The same places on nodes of their own part as soon as they move.
  TwoSquares apart;
  std::int64_t node[9] = {0, 1, 4, 5, 2, 3, 3, 6, 7};
  std::copy(node, node + 9, apart.node);
  StructurePluginDescription is = apart.description();
  is.node_count = is.own_count = 8;
  NodalVectors x(3, 8);
  x << 0, 1, 1, 2, 0, 1, 1, 2, /**/ 0, 0, 0, 0, 1, 1, 1, 1, /**/ 0, 0, 0, 0, 0, 0, 0, 0;
  EXPECT_NE(surface_at(read_skin(is), x).topology.border(0, 1).patch, 1);
}

template <class Change>
std::string complaint(Change change) {
  TwoSquares squares;
  StructurePluginDescription is = squares.description();
  change(squares, is);
  try {
    read_skin(is);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "none";
}

TEST(PluginSkin, RefusesWhatDoesNotFit) {
  using Is = StructurePluginDescription;
  const auto says = [](const char* words, auto change) { EXPECT_THAT(complaint(change), HasSubstr(words)); };
  says("patch_count is 0", [](TwoSquares&, Is& is) { is.patch_count = 0; });
  says("patches[1]: ", [](TwoSquares& s, Is&) { s.patches[1].degree[0] = 3; });
  says("patches[0].knots[1] is missing", [](TwoSquares& s, Is&) { s.patches[0].knots[1] = nullptr; });
  says("patches[1].outward is 2", [](TwoSquares& s, Is&) { s.patches[1].outward = 2; });
  says("node[3] is 6, expected 0 to 5", [](TwoSquares& s, Is&) { s.node[3] = 6; });
  says("factor[0] is not finite", [](TwoSquares& s, Is&) { s.factor[0] = std::nan(""); });
  says("first[2] is 1 after 1", [](TwoSquares& s, Is&) { s.first[2] = 1; });
  says("without 'node' or 'factor'", [](TwoSquares&, Is& is) { is.factor = nullptr; });
  says("node_count is 6, expected the 8 control points", [](TwoSquares&, Is& is) { is.first = nullptr; });
  says("own_count is 5, expected all 6", [](TwoSquares&, Is& is) { is.own_count = 5; });
  says("'own' is missing, expected 5 ids", [](TwoSquares&, Is& is) { is.own_count = 5, is.in_parts = 1; });
  says("own[2] is 1", [](TwoSquares& s, Is& is) { s.own[2] = 1, is.own = s.own; });
  const double masses[18] = {-1.0};
  says("inverse_mass", [&](TwoSquares&, Is& is) { is.inverse_mass = masses; });
}

TEST(OpaqueBytes, ComeBackWhateverTheyAre) {
  for (const std::size_t size : {0, 1, 5, 6, 7, 512}) {
    std::vector<unsigned char> bytes(size);
    std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(250));
    std::vector<double> numbers = coupling::numbers_from(bytes);
    EXPECT_EQ(coupling::bytes_from(numbers), bytes);
    numbers.push_back(0.0);
    EXPECT_THROW(coupling::bytes_from(numbers), std::invalid_argument) << size;
  }
  EXPECT_THROW(coupling::bytes_from({1.0, -1.0}), std::invalid_argument);
  EXPECT_THROW(coupling::bytes_from({}), std::invalid_argument);
}

}  // namespace
