// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes around blocks of 4^k x 4^k elements of a surface, a tree without pointers: which elements may be
// nearer to a point than something already found.  A block lies in the convex hull of its control points
// (Piegl & Tiller 1997, P4.8), so their box encloses it.  The sixteen boxes below a block are looked at
// together, in loops that compilers vectorise (box_units.h). Source: Samet (1984), "The quadtree and related
// hierarchical data structures".
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "search/box_units.h"
#include "search/power_element.h"

namespace search {

/// The elements [at_i 4^level, (at_i + 1) 4^level) of direction i, as far as there are.
struct ElementBlock {
  int level, at[2];
};

/// Elements begin_i <= e_i < end_i.
struct ElementWindow {
  int begin[2], end[2];
  bool holds(const int (&e)[2]) const {
    return begin[0] <= e[0] && e[0] < end[0] && begin[1] <= e[1] && e[1] < end[1];
  }
  bool holds(const ElementWindow& other) const {
    return begin[0] <= other.begin[0] && other.end[0] <= end[0] && begin[1] <= other.begin[1] &&
           other.end[1] <= end[1];
  }
};

class SurfaceTree {
 public:
  explicit SurfaceTree(const Space<2>& space);

  /// New coordinates (3 x n).
  void refit(const Eigen::Ref<const NodalVectors>& control_points);

  /// The block that holds all elements; its level is at least 1.
  ElementBlock root() const { return {static_cast<int>(levels_.size()), {0, 0}}; }
  static ElementBlock child(const ElementBlock& block, int k) {
    return {block.level - 1, {4 * block.at[0] + k % 4, 4 * block.at[1] + k / 4}};
  }
  ElementWindow elements(const ElementBlock& block) const {
    ElementWindow range;
    for (int i = 0; i < 2; ++i) {
      range.begin[i] = block.at[i] << 2 * block.level;
      range.end[i] = std::min((block.at[i] + 1) << 2 * block.level, elements_[i]);
    }
    return range;
  }
  /// Adds `first` + the numbers, in rising order, of all elements whose boxes are not farther than `reach`
  /// from `d`, and of some that are farther by no more than round-off in single precision.
  void query(const Vector3& d, double reach, int first, std::vector<int>& out) const;
  /// Length of the diagonal of the box around all control points.
  double size() const { return units_.size(); }

  /// A point in the tree's units.
  using Point = BoxUnits::Point;
  Point point(const Vector3& d) const { return units_.point(d); }
  using Lanes = BoxLanes<16>::Lanes;  // one number for each child
  /// Squared distances of a point from the children's boxes, infinite where there is no child; `add_middle2`
  /// adds those from their middles.
  Lanes near2(const ElementBlock& block, const Point& point) const { return children(block).near2(point); }
  Lanes add_middle2(const ElementBlock& block, const Point& point, const Lanes& near2) const {
    return children(block).add_middle2(point, near2);
  }
  /// Where the least of some numbers >= 0 is, up to differences of 16 ulps.
  static int least(const Lanes& numbers);
  /// Bit k: number k, all being >= 0, is less than the limit.
  static unsigned below(const Lanes& numbers, float limit);
  /// near2 from which on nothing in a box is nearer than a squared distance [length^2].
  float limit(const Point& point, double distance2) const {
    return units_.limit(point, std::sqrt(distance2));
  }

 private:
  struct Level {
    int count[2];  // blocks per direction
    std::vector<BoxLanes<16>> children;
  };
  const BoxLanes<16>& children(const ElementBlock& block) const {
    const Level& level = levels_[block.level - 1];
    return level.children[block.at[0] + level.count[0] * block.at[1]];
  }
  void fit_elements(const Eigen::Ref<const NodalVectors>& control_points);
  void add_near(const ElementBlock& block, const Point& point, float limit, int first,
                std::vector<int>& out) const;

  int elements_[2], degree_[2], control_points_0_;
  std::vector<int> first_[2];  // control point of each element, per direction
  std::vector<Level> levels_;  // of the blocks of level 1, 2, ...
  BoxUnits units_;
};

// As integers, floats that are not negative have the same order.
inline int SurfaceTree::least(const Lanes& numbers) {
  std::int32_t keys[16];
  std::memcpy(keys, numbers.data(), sizeof keys);
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  for (int k = 0; k < 16; ++k) least = std::min(least, (keys[k] & ~15) | k);
  return least & 15;
}

inline unsigned SurfaceTree::below(const Lanes& numbers, float limit) {
  std::int32_t keys[16], bound;
  std::memcpy(keys, numbers.data(), sizeof keys);
  std::memcpy(&bound, &limit, sizeof bound);
  std::int32_t bits = 0;
  for (int k = 0; k < 16; ++k) bits |= ((keys[k] - bound) >> 31) & (1 << k);  // the sign
  return static_cast<unsigned>(bits);
}

}  // namespace search
