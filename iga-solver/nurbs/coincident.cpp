// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/coincident.h"

#include <algorithm>

#include "nurbs/point_grid.h"

namespace nurbs {

// Points that stand for others are further apart than the tolerance, so that a cell of the grid holds a
// bounded number, however many points there are.
std::vector<int> first_coincident(const Eigen::Ref<const NodalVectors>& points, double relative_tolerance) {
  const int count = static_cast<int>(points.cols());
  std::vector<int> first(count, 0);
  if (count == 0) return first;
  const Vector3 low = points.rowwise().minCoeff();
  const double tolerance = relative_tolerance * (points.rowwise().maxCoeff() - low).stableNorm();
  if (tolerance == 0.0) return first;  // all are one
  PointGrid grid(tolerance, static_cast<std::size_t>(count), low);
  for (int i = 0; i < count; ++i) {
    first[i] = i;
    grid.for_each_near(points.col(i), [&](int other) { first[i] = std::min(first[i], other); });
    if (first[i] == i) grid.add(i, points.col(i));
  }
  return first;
}

}  // namespace nurbs
