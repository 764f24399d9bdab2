// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/multi_patch_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

Vector3 random_point(shapes::Random& random) {
  return {shapes::uniform(random, 0, 1), shapes::uniform(random, 0, 1), shapes::uniform(random, 0, 1)};
}

// Patches of hills here and there, of all sizes of the grid of elements.
PatchedSurface scattered(shapes::Random& random, int patches, double size = 1.0,
                         const Vector3& shift = Vector3::Zero()) {
  std::vector<Space<2>> spaces;
  std::vector<NodalVectors> points;
  Eigen::Index count = 0;
  for (int p = 0; p < patches; ++p) {
    const int n[2] = {1 + (p + patches) * 7 % 19, 1 + p * 5 % 18};
    Surface hills = shapes::random_hills(
        random, {shapes::random_knots(random, 1 + p % 3, n[0]), shapes::random_knots(random, 2, n[1])}, 0.2,
        p % 2 == 1);
    const Vector3 place = shift + 3.0 * size * random_point(random);
    points.push_back((size * hills.control_points).colwise() + place);
    count += points.back().cols();
    spaces.push_back(std::move(hills.space));
  }
  PatchedSurface surface{MultiPatch(std::move(spaces)), NodalVectors(3, count)};
  for (int p = 0; p < patches; ++p)
    surface.control_points.middleCols(surface.topology.first_control_point(p), points[p].cols()) = points[p];
  return surface;
}

std::vector<Box> element_boxes(const PatchedSurface& surface) {
  std::vector<Box> boxes;
  for (int p = 0; p < surface.topology.patch_count(); ++p) {
    const Space<2>& space = surface.topology.patch(p);
    const NodalVectors points = surface.topology.control_points_of(p, surface.control_points);
    for (int e = 0; e < space.element_count(); ++e) boxes.push_back(element_box(space, points, e));
  }
  return boxes;
}

TEST(MultiPatchTree, QueryEqualsBruteForce) {
  shapes::Random random(1);
  MultiPatchTree tree;  // the same for all: nothing is left of the one before
  std::vector<int> found;
  size_t hits = 0;
  for (int patches : {1, 2, 15, 16, 17, 40}) {
    const PatchedSurface surface = scattered(random, patches);
    const std::vector<Box> boxes = element_boxes(surface);
    tree.build(surface.topology, surface.control_points);
    for (int k = 0; k < 200; ++k) {
      const Vector3 point = 5.0 * random_point(random) - Vector3::Constant(0.5);
      const double reach = shapes::uniform(random, 0.0, 0.8);
      std::vector<int> expected{9999};  // what is there already stays
      for (size_t i = 0; i < boxes.size(); ++i) {
        const Vector3 nearest = point.cwiseMax(boxes[i].low).cwiseMin(boxes[i].high);
        if ((nearest - point).norm() <= reach) expected.push_back(static_cast<int>(i));
      }
      found.assign(1, 9999);
      tree.query(point, reach, found);
      EXPECT_EQ(found, expected);
      hits += found.size() - 1;
    }
  }
  EXPECT_GT(hits, 10000u);
}

// Boxes touched exactly, at any size and distance from the origin: single precision must not lose them.
TEST(MultiPatchTree, FindsWhatIsJustInReach) {
  shapes::Random random(4);
  MultiPatchTree tree;
  for (const double size : {1e-12, 1.0, 1e12})
    for (const double offset : {0.0, 1e3}) {
      const Vector3 shift = Vector3::Constant(offset * size);
      const PatchedSurface surface = scattered(random, 5, size, shift);
      const std::vector<Box> boxes = element_boxes(surface);
      const int count = static_cast<int>(boxes.size());
      tree.build(surface.topology, surface.control_points);
      for (int k = 0; k < 3000; ++k) {
        const int box = k % count;
        const Vector3 point = shift + size * (9.0 * random_point(random) - 3.0 * Vector3::Ones());
        std::vector<int> found;
        tree.query(point, std::sqrt(boxes[box].squared_distance(point)) * (1.0 + 1e-15), found);
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), box));
      }
    }
}

TEST(MultiPatchTree, PointsThatAreNotFiniteFindNothing) {
  shapes::Random random(5);
  const PatchedSurface surface = scattered(random, 3);
  MultiPatchTree tree;
  tree.build(surface.topology, surface.control_points);
  std::vector<int> found;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  tree.query({kNaN, 0.0, 0.0}, 1.0, found);
  tree.query({0.0, std::numeric_limits<double>::infinity(), 0.0}, 1.0, found);
  EXPECT_TRUE(found.empty());
}

TEST(MultiPatchTree, EmptyAndEqualPatches) {
  MultiPatchTree tree;
  std::vector<int> found;
  tree.query({0, 0, 0}, 1e9, found);
  EXPECT_TRUE(tree.empty());
  EXPECT_TRUE(found.empty());
  const Surface square =
      plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {KnotVector::uniform(1, 1), KnotVector::uniform(1, 1)});
  const NodalVectors points = square.control_points.replicate(1, 50);
  tree.build(MultiPatch(std::vector<Space<2>>(50, square.space)), points);
  tree.query({0.5, 0.5, 0.0}, 0.0, found);
  EXPECT_EQ(found.size(), 50u);
  EXPECT_EQ(tree.bounds().high, Vector3(1, 1, 0));
}

TEST(Box, OfAnElementEnclosesIt) {
  shapes::Random random(2);
  for (int k = 0; k < 10; ++k) {
    const Surface surface = shapes::random_patch<2>(random, 6, 4, k % 2);
    for (int sample = 0; sample < 500; ++sample) {
      const Parameter<2> xi = shapes::random_parameter(random, surface.space);
      const Vector3 point = interpolate(surface.space, surface.control_points, xi);
      const Box box = element_box(surface.space, surface.control_points, surface.space.element_at(xi));
      EXPECT_LE(box.squared_distance(point), 1e-30);
    }
  }
}

TEST(Box, OfAnElementIsTightOnCorners) {
  shapes::Random random(3);
  const Surface hills =
      shapes::random_hills(random, {KnotVector::uniform(1, 2), KnotVector::uniform(1, 2)}, 1.0, false);
  const Box box = element_box(hills.space, hills.control_points, 3);  // control points 4, 5, 7, 8 of 9
  const auto corners = hills.control_points(Eigen::all, std::vector<int>{4, 5, 7, 8});
  EXPECT_EQ(box.low, corners.rowwise().minCoeff());
  EXPECT_EQ(box.high, corners.rowwise().maxCoeff());
}

TEST(Box, OverlapAndInflation) {
  Box a{Vector3(0, 0, 0), Vector3(1, 1, 1)}, b{Vector3(1.5, 0, 0), Vector3(2, 1, 1)};
  EXPECT_FALSE(a.overlaps(b));
  a.inflate(0.25), b.inflate(0.25);
  EXPECT_TRUE(a.overlaps(b));
  EXPECT_DOUBLE_EQ(a.squared_distance({1.5, 1.5, 0}), 0.125);
  EXPECT_EQ(a.squared_distance({0.5, 0.5, 0.5}), 0.0);
}

}  // namespace
}  // namespace search
