// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/coincident.h"

#include <algorithm>
#include <numeric>

namespace nurbs {

std::vector<int> first_coincident(const NodalVectors& points, double relative_tolerance) {
  const int count = static_cast<int>(points.cols());
  std::vector<int> first(count), order(count);
  std::iota(first.begin(), first.end(), 0);
  if (count == 0) return first;
  order = first;
  const Vector3 extent = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  const double tolerance = relative_tolerance * extent.norm();

  // Sorted along a direction that grids do not lie along, so that few points are near in it by chance.
  const Eigen::VectorXd along = points.transpose() * Vector3(0.4181, 0.7327, 0.5369);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return along[a] < along[b]; });
  for (int i = 0; i < count; ++i)
    for (int k = i - 1; k >= 0 && along[order[i]] - along[order[k]] <= tolerance; --k)
      if ((points.col(order[i]) - points.col(order[k])).norm() <= tolerance) {
        const int lowest = std::min(first[order[i]], first[order[k]]);
        first[order[i]] = first[order[k]] = lowest;
      }
  for (int i = 0; i < count; ++i) first[i] = first[first[i]];
  return first;
}

}  // namespace nurbs
