// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a cut patch, without ranks: shares that go by hand from part to part add up as in one piece.
#include "structure/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "models.h"
#include "structure/weld.h"

namespace {

using models::NodalVectors;
using structure::Id;
using structure::Neighbour;
using structure::Part;
using structure::Partition;

/// 5 x 3 x 2 boxes; two directions with kinks, one of them at a cut.
struct Case {
  nurbs::KnotVector x = nurbs::KnotVector::uniform(2, 17),
                    y{3, {0, 0, 0, 0, .2, .3, .3, .3, .4, .6, .7, .75, .8, .9, .95, 1, 1, 1, 1}},
                    z{2, {0, 0, 0, .25, .5, .5, .75, 1, 1, 1}};
  nurbs::Space<3> space{{x, y, z}};
  structure::BoxCuts cuts{{{0, 3, 6, 10, 14, 17}, {0, 3, 6, 10}, {0, 2, 4}}};
};

/// Four blocks round an edge, the last of which is cut finer, and a wedge that is welded to itself; 15 boxes.
Partition welded_partition(int parts, Id* nodes = nullptr) {
  const nurbs::Volume block = models::block({1, 1, 1}, {4, 6, 4}, 2);
  std::vector<nurbs::Volume> patches(5, block);
  for (int p = 0; p < 4; ++p) patches[p].control_points.colwise() += models::Vector3(p % 2, p / 2, 0.0);
  patches[4].control_points.row(1) =
      patches[4].control_points.row(1).cwiseProduct(patches[4].control_points.row(0));
  patches[4].control_points.row(0).array() -= 1.0;
  std::vector<structure::PatchBoxes> boxes;
  for (int p = 0; p < 5; ++p)
    boxes.emplace_back(block.space, structure::BoxCuts{{{0, 2, 4}, {0, 6}, {0, 4}}});
  boxes[3] = structure::PatchBoxes(block.space, {{{0, 2, 4}, {0, 2, 6}, {0, 2, 4}}});
  const structure::NodeNumbering numbering = structure::weld(patches);
  if (nodes) *nodes = numbering.node_count();
  return {boxes, numbering, parts};
}

/// What a box adds to its nodes: sizes far apart, so that the order shows.
NodalVectors box_forces(int box, Eigen::Index nodes) {
  NodalVectors f = models::random_vectors(static_cast<int>(nodes), 100 + box);
  for (Eigen::Index a = 0; a < nodes; ++a) f.col(a) *= std::pow(10.0, (box * 7 + a) % 9);
  return f;
}

NodalVectors in_one_piece(const Partition& partition, int node_count) {
  NodalVectors f = NodalVectors::Zero(3, node_count);
  for (int box = 0; box < partition.box_count(); ++box) {
    const std::vector<Id> nodes = partition.nodes_of(box);
    const NodalVectors share = box_forces(box, nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) f.col(nodes[a]) += share.col(a);
  }
  return f;
}

std::vector<Part> all_parts(const Partition& partition, int count) {
  std::vector<Part> parts;
  for (int p = 0; p < count; ++p) parts.push_back(partition.part(p));
  return parts;
}

/// Nodes of columns.
std::vector<Id> ids(const Part& part, const std::vector<int>& columns) {
  std::vector<Id> ids;
  for (const int column : columns) ids.push_back(part.nodes[column]);
  return ids;
}

const Neighbour& of(const Part& part, int other) {
  return *std::find_if(part.neighbours.begin(), part.neighbours.end(),
                       [&](const Neighbour& n) { return n.part == other; });
}

/// First ids and sizes of runs.
std::vector<std::pair<Id, Id>> runs(const std::vector<Part>& parts) {
  std::vector<std::pair<Id, Id>> runs;
  for (const Part& part : parts)
    for (std::size_t k = 0; k < part.runs.size(); ++k) {
      const Id end = k + 1 < part.runs.size() ? part.runs[k + 1] : part.owned;
      runs.emplace_back(part.nodes[part.runs[k]], end - part.runs[k]);
    }
  std::sort(runs.begin(), runs.end());
  return runs;
}

template <class Cut>
void expect_sums_as_in_one_piece(Id node_count, Cut cut) {
  const NodalVectors whole = in_one_piece(cut(1), static_cast<int>(node_count));
  for (int count = 1; count <= 12; ++count) {
    SCOPED_TRACE(count);
    const std::vector<Part> parts = all_parts(cut(count), count);
    std::vector<NodalVectors> f;
    for (const Part& part : parts) {
      f.push_back(NodalVectors::Zero(3, part.columns));
      for (std::size_t b = 0; b < part.boxes.size(); ++b) {
        const NodalVectors share = box_forces(part.boxes[b], part.scatter[b].size());
        for (std::size_t a = 0; a < part.scatter[b].size(); ++a)
          f.back().col(part.scatter[b][a]) += share.col(a);
      }
    }
    for (int p = 0; p < count; ++p)
      for (const Neighbour& n : parts[p].neighbours) {
        const std::vector<int>& from = of(parts[n.part], p).shares_out;
        ASSERT_EQ(from.size(), n.shares_in.size());
        for (std::size_t i = 0; i < from.size(); ++i) f[p].col(n.shares_in[i]) = f[n.part].col(from[i]);
      }
    Id owned = 0;
    for (int p = 0; p < count; ++p) {
      add_shares(parts[p], f[p]);
      for (int column = 0; column < parts[p].owned; ++column)
        ASSERT_EQ(f[p].col(column), whole.col(parts[p].nodes[column])) << parts[p].nodes[column];
      owned += parts[p].owned;
    }
    EXPECT_EQ(owned, node_count) << "every node is owned once";
  }
}

TEST(Partition, SharesAddUpAsInOnePieceToTheLastBit) {
  const Case c;
  expect_sums_as_in_one_piece(c.space.control_point_count(),
                              [&](int parts) { return Partition(c.space, c.cuts, parts); });
}

TEST(Partition, SharesOfWeldedPatchesDoToo) {
  Id nodes;
  welded_partition(1, &nodes);
  expect_sums_as_in_one_piece(nodes, [](int parts) { return welded_partition(parts); });
}

// Each patch of 96 elements; three parts have 160 each.
TEST(Partition, PatchesAreSharedOutByTheirElements) {
  for (const int count : {2, 3, 5, 7}) {
    std::vector<Id> elements;
    for (const Part& part : all_parts(welded_partition(count), count)) elements.push_back(part.element_count);
    EXPECT_EQ(std::accumulate(elements.begin(), elements.end(), Id(0)), 480);
    EXPECT_LE(*std::max_element(elements.begin(), elements.end()), 480 / count + 48) << count;
    EXPECT_GE(*std::min_element(elements.begin(), elements.end()), 32) << count;
  }
}

TEST(Partition, RunsOfWeldedPatchesDoNotDependOnTheParts) {
  const auto one = runs(all_parts(welded_partition(1), 1));
  for (const int count : {2, 5, 9}) EXPECT_EQ(runs(all_parts(welded_partition(count), count)), one);
}

TEST(Partition, GhostsAreTheOwnersNodesInTheSameOrder) {
  const Case c;
  const Partition partition(c.space, c.cuts, 7);
  const std::vector<Part> parts = all_parts(partition, 7);
  for (int p = 0; p < 7; ++p) {
    std::size_t ghosts = 0;
    for (const Neighbour& n : parts[p].neighbours) {
      EXPECT_EQ(ids(parts[p], n.ghosts), ids(parts[n.part], of(parts[n.part], p).own));
      for (const int column : n.own) EXPECT_LT(column, parts[p].owned);
      for (const int column : n.ghosts) EXPECT_EQ(partition.owner(parts[p].nodes[column]), n.part);
      ghosts += n.ghosts.size();
    }
    EXPECT_EQ(parts[p].owned + ghosts, parts[p].nodes.size());
  }
}

TEST(Partition, TablesLeadToTheNodesOfTheBox) {
  const Case c;
  const Partition partition(c.space, c.cuts, 4);
  for (int p = 0; p < 4; ++p) {
    const Part part = partition.part(p);
    for (std::size_t b = 0; b < part.boxes.size(); ++b)
      EXPECT_EQ(ids(part, part.gather[b]), partition.nodes_of(part.boxes[b]));
  }
}

TEST(Partition, EveryElementIsInOnePart) {
  const Case c;
  std::vector<Id> elements;
  for (const Part& part : all_parts(Partition(c.space, c.cuts, 3), 3))
    for (Id held = 0; held < part.element_count; ++held) elements.push_back(part.element(held));
  std::sort(elements.begin(), elements.end());
  std::vector<Id> all(c.space.element_count());
  std::iota(all.begin(), all.end(), Id(0));
  EXPECT_EQ(elements, all);
}

TEST(Partition, RunsOfNodesDoNotDependOnTheParts) {
  const Case c;
  const auto one = runs(all_parts(Partition(c.space, c.cuts, 1), 1));
  EXPECT_EQ(one.size(), 5u * 15 * 7) << "five boxes cut each line";
  for (const int count : {2, 5, 9}) EXPECT_EQ(runs(all_parts(Partition(c.space, c.cuts, count), count)), one);
}

TEST(Partition, BoxesWithGhostsComeFirst) {
  const Case c;
  const Partition partition(c.space, c.cuts, 5);
  for (int p = 0; p < 5; ++p) {
    const Part part = partition.part(p);
    for (std::size_t b = 0; b < part.boxes.size(); ++b) {
      const bool ghosts = std::any_of(part.gather[b].begin(), part.gather[b].end(),
                                      [&](int column) { return column >= part.owned; });
      EXPECT_EQ(ghosts, int(b) < part.patches.front().border);
    }
  }
}

TEST(Partition, PartsAreEquallyLargeAsFarAsBoxesAllow) {
  const auto knots = nurbs::KnotVector::uniform(2, 64);
  const std::vector<int> cuts{0, 8, 16, 24, 32, 40, 48, 56, 64};
  const Partition partition(nurbs::Space<3>({knots, knots, nurbs::KnotVector::uniform(2, 8)}),
                            {cuts, cuts, {0, 8}}, 6);
  std::vector<int> boxes(6);
  for (int box = 0; box < partition.box_count(); ++box) ++boxes[partition.part_of(box)];
  EXPECT_EQ(std::accumulate(boxes.begin(), boxes.end(), 0), 64);
  EXPECT_GE(*std::min_element(boxes.begin(), boxes.end()), 8);
  EXPECT_LE(*std::max_element(boxes.begin(), boxes.end()), 12);
}

TEST(Partition, MorePartsThanBoxesLeaveSomeWithout) {
  const Case c;
  const Partition partition(c.space, {{{0, 8, 17}, {0, 10}, {0, 4}}}, 5);
  std::vector<Part> parts = all_parts(partition, 5);
  EXPECT_EQ(std::count_if(parts.begin(), parts.end(), [](const Part& part) { return part.boxes.empty(); }),
            3);
  for (const Part& part : parts) {
    EXPECT_EQ(part.nodes.empty(), part.boxes.empty());
  }
}

TEST(Partition, RefusesBoxesThatAreTooSmall) {
  const Case c;
  EXPECT_THROW(Partition(c.space, {{{0, 1, 17}, {0, 10}, {0, 4}}}, 2), std::invalid_argument);
}

}  // namespace
