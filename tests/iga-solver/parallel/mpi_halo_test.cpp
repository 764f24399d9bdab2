// SPDX-License-Identifier: GPL-2.0-or-later
// What ranks tell each other of a cut body, held against the body in one piece.
#include "parallel/mpi_halo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using parallel::MpiHalo;
using structure::ExactSum;
using structure::Id;
using structure::Part;
using structure::Partition;

struct Ranks {
  Ranks() {
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
  }
  int me, count;
};

/// 3 x 2 x 1 boxes.
struct Cut {
  nurbs::Space<3> space{
      {nurbs::KnotVector::uniform(2, 9), nurbs::KnotVector::uniform(3, 8), nurbs::KnotVector::uniform(2, 2)}};
  structure::BoxCuts cuts{{{0, 3, 6, 9}, {0, 4, 8}, {0, 2}}};
  Partition partition{space, cuts, Ranks().count};
  Part part = partition.part(Ranks().me);
  MpiHalo halo{MPI_COMM_WORLD, part};

  NodalVectors zero() const { return NodalVectors::Zero(3, part.columns); }
  /// Its columns of a field on all nodes.
  NodalVectors held(const NodalVectors& whole) const {
    NodalVectors values = zero();
    for (int column = 0; column < part.held(); ++column) values.col(column) = whole.col(part.nodes[column]);
    return values;
  }
};

/// What a box adds to its nodes: sizes far apart, so that the order shows.
NodalVectors box_forces(int box, std::size_t nodes) {
  NodalVectors f = models::random_vectors(static_cast<int>(nodes), 100 + box);
  for (std::size_t a = 0; a < nodes; ++a) f.col(a) *= std::pow(10.0, (box * 7 + a) % 9);
  return f;
}

TEST(MpiHalo, ForcesAreSummedAsInOnePieceToTheLastBit) {
  const Cut cut;
  NodalVectors whole = NodalVectors::Zero(3, cut.space.control_point_count());
  for (int box = 0; box < cut.partition.box_count(); ++box) {
    const std::vector<Id> nodes = cut.partition.nodes_of(box);
    const NodalVectors share = box_forces(box, nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) whole.col(nodes[a]) += share.col(a);
  }
  const auto add = [&](int first, int end, NodalVectors& f) {
    for (int b = first; b < end; ++b) {
      const std::vector<int>& columns = cut.part.scatter[b];
      const NodalVectors share = box_forces(cut.part.boxes[b], columns.size());
      for (std::size_t a = 0; a < columns.size(); ++a) f.col(columns[a]) += share.col(a);
    }
  };
  for (int step = 0; step < 3; ++step) {  // requests serve again
    NodalVectors f = cut.zero();
    add(0, cut.part.patches.front().border, f);
    cut.halo.begin_sum(f);
    add(cut.part.patches.front().border, static_cast<int>(cut.part.boxes.size()), f);
    cut.halo.finish_sum(f);
    for (int column = 0; column < cut.part.owned; ++column)
      ASSERT_EQ(f.col(column), whole.col(cut.part.nodes[column]));
    EXPECT_EQ(f.rightCols(cut.part.columns - cut.part.held()).cwiseAbs().sum(), 0.0);
  }
}

TEST(MpiHalo, GhostsTakeWhatTheirOwnersHave) {
  const Cut cut;
  const NodalVectors whole = models::random_vectors(cut.space.control_point_count(), 4),
                     expected = cut.held(whole);
  NodalVectors values = expected;
  values.rightCols(cut.part.columns - cut.part.owned).setConstant(-99.0);
  cut.halo.owners_to_ghosts(values);
  EXPECT_EQ(values.leftCols(cut.part.held()), expected.leftCols(cut.part.held()));
}

TEST(MpiHalo, ScalarProductsAreTheSameOnAnyNumberOfRanks) {
  const Cut cut;
  const NodalVectors a = models::random_vectors(cut.space.control_point_count(), 5),
                     b = models::random_vectors(cut.space.control_point_count(), 6);
  const Part one = Partition(cut.space, cut.cuts, 1).part(0);
  const double expected = structure::Halo(one.runs).dot(a, b);
  EXPECT_EQ(cut.halo.dot(cut.held(a), cut.held(b)), expected) << "to the last bit";
  EXPECT_NEAR(expected, a.cwiseProduct(b).sum(), 1e-12);
}

TEST(MpiHalo, TheLargestIsNoNumberIfOneIsNone) {
  const Cut cut;
  const Ranks ranks;
  EXPECT_EQ(cut.halo.largest(ranks.me - 7.0), ranks.count - 8.0);
  EXPECT_TRUE(std::isnan(cut.halo.largest(ranks.me == 0 ? std::nan("") : 1.0)));
  EXPECT_TRUE(cut.halo.any(ranks.me == ranks.count - 1));
  EXPECT_FALSE(cut.halo.any(false));
}

TEST(MpiHalo, RowsComeInTheOrderOfIds) {
  const Cut cut;
  const NodalVectors whole = models::random_vectors(cut.space.control_point_count(), 4);
  const NodalVectors own = cut.held(whole).leftCols(cut.part.owned);
  std::vector<Id> ids(cut.part.nodes.begin(), cut.part.nodes.begin() + cut.part.owned);
  const std::vector<double> all = cut.halo.in_order(ids, own.data(), own.size());
  ASSERT_EQ(all.size(), std::size_t(whole.size()));
  EXPECT_EQ(NodalVectors::Map(all.data(), 3, whole.cols()), whole);
  EXPECT_TRUE(cut.halo.in_order(ids, nullptr, 0).empty()) << "rows without numbers";
}

TEST(MpiHalo, ManyRowsComeInSlicesWhateverTheirOrder) {
  constexpr Id kMany = 150001;
  const Cut cut;
  const Ranks ranks;
  std::vector<Id> ids;  // falling, every rank's between all others'
  std::vector<double> rows, all;
  for (Id id = kMany - 1; id >= 0; --id)
    if (id % ranks.count == ranks.me) {
      ids.push_back(id);
      rows.insert(rows.end(), {1.0 * id, -0.5 * id});
    }
  int slices = 0;
  cut.halo.in_slices(ids, rows.data(), rows.size(), [&](const double* some, std::size_t numbers) {
    all.insert(all.end(), some, some + numbers);
    ++slices;
  });
  EXPECT_GT(slices, 1);
  ASSERT_EQ(all.size(), std::size_t(2 * kMany));
  for (Id id = 0; id < kMany; ++id) {
    ASSERT_EQ(all[2 * id], 1.0 * id);
    ASSERT_EQ(all[2 * id + 1], -0.5 * id);
  }
}

TEST(MpiHalo, MassesAreWholeAndNoColumnIsWithout) {
  const Cut cut;
  Eigen::VectorXd share = Eigen::VectorXd::Zero(cut.part.columns);
  for (const std::vector<int>& columns : cut.part.scatter)
    for (const int column : columns) share[column] += 1.0;
  const Eigen::VectorXd mass = whole(cut.halo, share);
  for (int column = 0; column < cut.part.held(); ++column)
    EXPECT_EQ(mass[column], cut.partition.boxes_of(cut.part.nodes[column]).count());
  EXPECT_EQ(mass.tail(cut.part.columns - cut.part.held()).sum(), cut.part.columns - cut.part.held());
}

}  // namespace
