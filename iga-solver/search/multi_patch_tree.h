// SPDX-License-Identifier: GPL-2.0-or-later
// Global search: which elements of a surface of patches may be near a point.  A box for each patch, and the
// tree of its elements (surface_tree.h).  Source: Gao & Feng (2019), section 4.1, with trees in place of
// their CGRID.
#pragma once

#include <vector>

#include "search/box.h"
#include "search/surface_tree.h"

namespace search {

class MultiPatchTree {
 public:
  /// Of a surface with these control points (3 x n); nothing is kept by reference.
  void build(const MultiPatch& surface, const NodalVectors& control_points);
  /// Adds the numbers, in rising order, of all elements whose boxes are not farther than `reach` from
  /// `point`, and of some that are farther by no more than round-off in single precision; none if the point
  /// is not finite.
  void query(const Vector3& point, double reach, std::vector<int>& out) const;
  /// Box of everything; undefined while empty.
  const Box& bounds() const { return bounds_; }
  bool empty() const { return trees_.empty(); }

 private:
  static constexpr int kLanes = 16;

  Box bounds_;
  BoxUnits units_;
  std::vector<BoxLanes<kLanes>> patches_;  // box of patch p in lane p % kLanes of p / kLanes
  std::vector<SurfaceTree> trees_;         // of each patch
  std::vector<int> first_element_;         // likewise
};

}  // namespace search
