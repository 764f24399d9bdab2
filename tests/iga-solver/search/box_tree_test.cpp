// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

Vector3 random_point(shapes::Random& random) {
  return {shapes::uniform(random, 0, 1), shapes::uniform(random, 0, 1), shapes::uniform(random, 0, 1)};
}

TEST(BoxTree, QueryEqualsBruteForce) {
  shapes::Random random(1);
  BoxTree tree;
  std::vector<int> found;
  for (int count : {1, 2, 5, 37, 1000}) {
    std::vector<Box> boxes;
    for (int i = 0; i < count; ++i) {
      const Vector3 low = random_point(random);
      boxes.push_back({low, low + 0.1 * random_point(random)});
    }
    tree.build(boxes);
    for (int k = 0; k < 200; ++k) {
      const Vector3 point = 2.0 * random_point(random) - Vector3::Constant(0.5);
      const double reach = shapes::uniform(random, 0.0, 0.4);
      std::vector<int> expected{9999};  // what is there already stays
      for (int i = 0; i < count; ++i) {
        const Vector3 nearest = point.cwiseMax(boxes[i].low).cwiseMin(boxes[i].high);
        if ((nearest - point).norm() <= reach) expected.push_back(i);
      }
      found.assign(1, 9999);
      tree.query(point, reach, found);
      EXPECT_EQ(found, expected);
    }
  }
}

// Boxes touched exactly, at any size and distance from the origin: single precision must not lose them.
TEST(BoxTree, FindsWhatIsJustInReach) {
  shapes::Random random(4);
  BoxTree tree;
  for (const double size : {1e-12, 1.0, 1e12})
    for (const double offset : {0.0, 1e3}) {
      const Vector3 shift = Vector3::Constant(offset * size);
      std::vector<Box> boxes;
      for (int i = 0; i < 300; ++i) {
        const Vector3 low = shift + size * random_point(random);
        boxes.push_back({low, low + 0.05 * size * random_point(random)});
      }
      tree.build(boxes);
      for (int k = 0; k < 3000; ++k) {
        const int box = k % 300;
        const Vector3 point = shift + size * (3.0 * random_point(random) - Vector3::Ones());
        std::vector<int> found;
        tree.query(point, std::sqrt(boxes[box].squared_distance(point)) * (1.0 + 1e-15), found);
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), box));
      }
    }
}

TEST(BoxTree, PointsThatAreNotFiniteFindNothing) {
  BoxTree tree;
  tree.build(std::vector<Box>(5, Box{Vector3::Zero(), Vector3::Ones()}));
  std::vector<int> found;
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  tree.query({kNaN, 0.0, 0.0}, 1.0, found);
  tree.query({0.0, std::numeric_limits<double>::infinity(), 0.0}, 1.0, found);
  EXPECT_TRUE(found.empty());
}

TEST(BoxTree, EmptyAndEqualBoxes) {
  BoxTree tree;
  std::vector<int> found;
  tree.build({});
  tree.query({0, 0, 0}, 1e9, found);
  EXPECT_TRUE(tree.empty());
  EXPECT_TRUE(found.empty());
  tree.build(std::vector<Box>(50, Box{Vector3::Zero(), Vector3::Ones()}));
  tree.query({0.5, 0.5, 0.5}, 0.0, found);
  EXPECT_EQ(found.size(), 50u);
  EXPECT_EQ(tree.bounds().high, Vector3::Ones());
}

TEST(BoxTree, ElementBoxEnclosesElement) {
  shapes::Random random(2);
  for (int k = 0; k < 10; ++k) {
    const Surface surface = shapes::random_patch<2>(random, 6, 4, k % 2);
    std::vector<Box> boxes;
    add_element_boxes(surface.space, surface.control_points, boxes);
    ASSERT_EQ(static_cast<int>(boxes.size()), surface.space.element_count());
    for (int sample = 0; sample < 500; ++sample) {
      const Parameter<2> xi = shapes::random_parameter(random, surface.space);
      const Vector3 point = interpolate(surface.space, surface.control_points, xi);
      EXPECT_LE(boxes[surface.space.element_at(xi)].squared_distance(point), 1e-30);
    }
  }
}

TEST(BoxTree, ElementBoxIsTightOnCorners) {
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
