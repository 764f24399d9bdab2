// SPDX-License-Identifier: GPL-2.0-or-later
// Points that stand at the same place: poles, seams, borders between patches.
#pragma once

#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

/// Per point (column) the lowest index of those within `relative_tolerance` times the extent of all points.
std::vector<int> first_coincident(const NodalVectors& points, double relative_tolerance = 1e-9);

/// Whether (i, j) of an n x m grid, index i + n j, lies on its rim.
inline bool on_rim(int index, int n, int m) {
  const int i = index % n, j = index / n;
  return i == 0 || i == n - 1 || j == 0 || j == m - 1;
}

}  // namespace nurbs
