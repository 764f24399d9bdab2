// SPDX-License-Identifier: GPL-2.0-or-later
// The tree's boxes against those of the elements' control points, in double precision.
#include "search/surface_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/shapes.h"
#include "search/box.h"

namespace search {
namespace {

using namespace nurbs;

using shapes::uniform;

Box box_of(const Surface& surface, const ElementWindow& elements) {
  Box box{Vector3::Constant(INFINITY), Vector3::Constant(-INFINITY)};
  for (int j = elements.begin[1]; j < elements.end[1]; ++j)
    for (int i = elements.begin[0]; i < elements.end[0]; ++i) {
      const Box element =
          element_box(surface.space, surface.control_points, surface.space.element_index({i, j}));
      box.low = box.low.cwiseMin(element.low), box.high = box.high.cwiseMax(element.high);
    }
  return box;
}

class Comparison {
 public:
  Comparison(const Surface& surface, const SurfaceTree& tree, const Vector3& d)
      : surface_(surface), tree_(tree), d_(d), point_(tree.point(d)) {}

  // Number of elements seen, each once.
  int visit(const ElementBlock& block) const {
    if (block.level == 0) return 1;
    const SurfaceTree::Lanes near2 = tree_.near2(block, point_),
                             middle2 = tree_.add_middle2(block, point_, SurfaceTree::Lanes::Zero());
    int count = 0;
    for (int k = 0; k < 16; ++k) {
      const ElementBlock child = SurfaceTree::child(block, k);
      const ElementWindow own = tree_.elements(child);
      if (own.begin[0] >= own.end[0] || own.begin[1] >= own.end[1]) {
        EXPECT_TRUE(std::isinf(near2[k]) && std::isinf(middle2[k]));
        continue;
      }
      compare(box_of(surface_, own), near2[k], middle2[k]);
      count += visit(child);
    }
    return count;
  }

 private:
  // A limit just above the distance lets the box pass, one clearly below keeps it out.
  void compare(const Box& box, float near2, float middle2) const {
    const double near = std::sqrt(box.squared_distance(d_));
    const double far = (d_ - box.low).cwiseAbs().cwiseMax((d_ - box.high).cwiseAbs()).norm();
    const double tolerance = 1e-6 * (tree_.size() + far);
    const auto limit = [&](double distance) { return tree_.limit(point_, distance * distance); };
    EXPECT_LT(near2, limit(near * (1.0 + 1e-12) + 1e-12 * far));
    EXPECT_GE(near2, near > tolerance ? limit(near - tolerance) : 0.0f);
    const double middle = (0.5 * (box.low + box.high) - d_).norm();
    EXPECT_LT(middle2, limit(middle + tolerance));
    EXPECT_GE(middle2, middle > tolerance ? limit(middle - tolerance) : 0.0f);
  }

  const Surface& surface_;
  const SurfaceTree& tree_;
  Vector3 d_;
  SurfaceTree::Point point_;
};

TEST(SurfaceTree, BoxesAreThoseOfTheControlPoints) {
  shapes::Random random(41);
  for (int k = 0; k < 60; ++k) {
    const double scale = std::pow(10.0, uniform(random, -30.0, 30.0));
    const int elements[2] = {1 + k % 7, 1 + k * 5 % 23};
    Surface surface = shapes::random_hills(random,
                                           {shapes::random_knots(random, 1 + k % 5, elements[0]),
                                            shapes::random_knots(random, 1 + k % 3, elements[1])},
                                           0.3, k % 2 == 1);
    const Vector3 centre = k % 4 == 3 ? Vector3(600.0, -640.0, 480.0) : Vector3::Zero();
    surface.control_points = (scale * (surface.control_points.colwise() + centre)).eval();
    SurfaceTree tree(surface.space);
    for (const double grown : {1.0, 1.5}) {  // the second time over what is there
      surface.control_points = (grown * surface.control_points).eval();
      tree.refit(surface.control_points);
      for (const double away : {0.1, 1.0, 1e3}) {
        const Vector3 d =
            surface.control_points.col(0) +
            away * scale * Vector3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        EXPECT_EQ(Comparison(surface, tree, d).visit(tree.root()), surface.space.element_count());
      }
    }
  }
}

TEST(SurfaceTree, LeastAndBelow) {
  shapes::Random random(42);
  for (int k = 0; k < 200; ++k) {
    SurfaceTree::Lanes x;
    for (int i = 0; i < 16; ++i) x[i] = static_cast<float>(std::pow(10.0, uniform(random, -30.0, 30.0)));
    for (int i = 0; i < k % 16; ++i) x[15 - i] = std::numeric_limits<float>::infinity();
    x[k % 5] = k % 3 == 0 ? 0.0f : x[k % 5];
    const float limit = k % 7 == 0 ? std::numeric_limits<float>::infinity() : x[k % 16];
    EXPECT_EQ(SurfaceTree::least(x), std::min_element(x.data(), x.data() + 16) - x.data());
    for (int i = 0; i < 16; ++i) EXPECT_EQ(SurfaceTree::below(x, limit) >> i & 1u, x[i] < limit ? 1u : 0u);
  }
}

}  // namespace
}  // namespace search
