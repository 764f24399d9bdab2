// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/grid_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace structure {

namespace {

/// Between row `low` and the next one of an axis: the share of the next.
struct Place {
  std::size_t low;
  double share;
};

Place place_in(const std::vector<double>& axis, double at) {
  if (axis.size() < 2 || at <= axis.front()) return {0, 0.0};
  if (at >= axis.back()) return {axis.size() - 2, 1.0};
  const std::size_t high = std::upper_bound(axis.begin(), axis.end(), at) - axis.begin();
  return {high - 1, (at - axis[high - 1]) / (axis[high] - axis[high - 1])};
}

void check(const GridAxes& axes, std::size_t rows) {
  std::size_t points = 1;
  for (const std::vector<double>& axis : axes) {
    for (std::size_t i = 1; i < axis.size(); ++i)
      if (!(axis[i - 1] < axis[i]))
        throw std::invalid_argument(
            fmt::format("{} follows {} along an axis, expected rising numbers", axis[i], axis[i - 1]));
    points *= std::max<std::size_t>(1, axis.size());
  }
  if (rows != points)
    throw std::invalid_argument(
        fmt::format("{} rows, expected {}, one for each point of the grid", rows, points));
}

}  // namespace

Field grid_table(GridAxes axes, std::vector<nurbs::Vector3> rows) {
  check(axes, rows.size());
  return [axes = std::move(axes), rows = std::move(rows)](const nurbs::Vector3& X, double t) {
    const double at[4] = {X[0], X[1], X[2], t};
    Place places[4];
    for (int d = 0; d < 4; ++d) places[d] = place_in(axes[d], at[d]);
    nurbs::Vector3 value = nurbs::Vector3::Zero();
    for (int corner = 0; corner < 16; ++corner) {
      double weight = 1.0;
      std::size_t row = 0, stride = 1;
      for (int d = 0; d < 4; ++d) {
        const bool is_next = corner >> d & 1;
        weight *= is_next ? places[d].share : 1.0 - places[d].share;
        row += stride * (places[d].low + is_next);
        stride *= std::max<std::size_t>(1, axes[d].size());
      }
      if (weight > 0.0) value += weight * rows[row];
    }
    return value;
  };
}

}  // namespace structure
