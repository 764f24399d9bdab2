// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/cross_shift.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace {

using coupling::CrossShift;
using coupling::NodeId;
using coupling::SurfaceMap;
using nurbs::NodalVectors;
using nurbs::Vector3;

/// Five control points on nodes 7, 3, 9, 3, 4: two are one node, as on a seam.  Links 3 - 7 - 9 - 4.
CrossShift seam() {
  return {SurfaceMap::selection({7, 3, 9, 3, 4}, 12), {{3, 7, 0.5}, {4, 9, 0.25}, {7, 9, 2.0}}};
}

NodalVectors forces(const std::vector<double>& along_z) {
  NodalVectors f = NodalVectors::Zero(3, static_cast<Eigen::Index>(along_z.size()));
  for (std::size_t c = 0; c < along_z.size(); ++c) f(2, static_cast<Eigen::Index>(c)) = along_z[c];
  return f;
}

const std::vector<int> kAll = {0, 1, 2, 3, 4};

/// Of control points 0 to 4, along z.
std::vector<double> shifts(const CrossShift& shift) {
  std::vector<double> z;
  for (const int c : kAll) z.push_back(Vector3(shift.at(c))[2]);
  return z;
}

TEST(CrossShift, IsWhatLinksTakeOff) {
  CrossShift shift = seam();
  for (int step = 0; step < 2; ++step) shift.remember(kAll, forces({1.0, 2.0, 4.0, 3.0, 8.0}));
  shift.begin_step();
  // Nodes 7, 3, 9, 4 have 1, 2 + 3, 4, 8.
  const double at_7 = 0.5 * (1 - 5) + 2.0 * (1 - 4), at_3 = 0.5 * (5 - 1),
               at_9 = 2.0 * (4 - 1) + 0.25 * (4 - 8), at_4 = 0.25 * (8 - 4);
  EXPECT_EQ(shifts(shift), (std::vector<double>{-at_7, -at_3, -at_9, -at_3, -at_4}));
}

TEST(CrossShift, CarriesForcesOnByAStraightLine) {
  CrossShift shift = seam();
  shift.remember({0}, forces({1.0, 0, 0, 0, 0}));
  shift.remember({0}, forces({1.5, 0, 0, 0, 0}));
  shift.begin_step();
  EXPECT_EQ(shifts(shift), (std::vector<double>{-2.5 * 2.0, 0.5 * 2.0, 2.0 * 2.0, 0.5 * 2.0, 0.0}));
  shift.remember({}, forces({0, 0, 0, 0, 0}));  // it has come apart
  shift.begin_step();
  EXPECT_EQ(shifts(shift)[0], 2.5 * 1.5);
  shift.remember({}, forces({0, 0, 0, 0, 0}));
  shift.begin_step();
  EXPECT_EQ(shifts(shift), std::vector<double>(5, 0.0));
}

TEST(CrossShift, LeavesForcesThatAreTheSameOnAllNodesAlone) {
  CrossShift shift = seam();
  for (int step = 0; step < 2; ++step) shift.remember(kAll, forces({6.0, 2.0, 6.0, 4.0, 6.0}));
  shift.begin_step();
  EXPECT_EQ(shifts(shift), std::vector<double>(5, 0.0));
}

TEST(CrossShift, GoesOnFromItsState) {
  CrossShift shift = seam(), other = seam();
  shift.remember(kAll, forces({1.0, 2.0, 4.0, 3.0, 8.0}));
  shift.begin_step();
  shift.remember({0, 2}, forces({2.0, 0, 7.0, 0, 0}));
  other.load(shift.save(kAll));
  EXPECT_EQ(shifts(other), shifts(shift));
  for (CrossShift* one : {&shift, &other}) one->begin_step();
  EXPECT_EQ(shifts(other), shifts(shift));
  EXPECT_THROW(other.load({1.0}), std::invalid_argument);
}

TEST(CrossShift, TellsWhatAControlPointIsLinkedTo) {
  std::vector<int> linked;
  seam().for_each_linked(2, [&](int c) { linked.push_back(c); });
  EXPECT_EQ(linked, (std::vector<int>{4, 0}));
}

}  // namespace
