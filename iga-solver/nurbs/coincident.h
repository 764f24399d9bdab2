// SPDX-License-Identifier: GPL-2.0-or-later
// Points that stand at the same place: poles, seams, borders between patches, corners of triangles.
#pragma once

#include <vector>

#include "nurbs/types.h"

namespace nurbs {

/// Per point (column) the lowest index of those within `relative_tolerance` (> 0) times the extent of all
/// points that stand for themselves: each point joins an earlier one, or is one that later ones may join.
/// Takes a time that grows with their number.
std::vector<int> first_coincident(const Eigen::Ref<const NodalVectors>& points,
                                  double relative_tolerance = 1e-9);

/// Whether (i, j) of an n x m grid, index i + n j, lies on its rim.
inline bool on_rim(int index, int n, int m) {
  const int i = index % n, j = index / n;
  return i == 0 || i == n - 1 || j == 0 || j == m - 1;
}

}  // namespace nurbs
