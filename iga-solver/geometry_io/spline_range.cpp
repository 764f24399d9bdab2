// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/spline_range.h"

#include <algorithm>
#include <vector>

#include "geometry_io/golden_section.h"

namespace geometry_io {

Range range_of(const AnySpline& curve, int coordinate) {
  const auto n = curve.points.cols();
  const auto dim = curve.points.rows() - 1;
  const Eigen::ArrayXd of_points = curve.points.row(coordinate).array() / curve.points.row(dim).array();
  const double ends[] = {of_points(0), of_points(n - 1)};
  Range range{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
  // Inside the hull of its points.
  if (of_points.minCoeff() >= range.low && of_points.maxCoeff() <= range.high) return range;
  const int parts = 8 * static_cast<int>(n);
  const auto at = [&](double t) { return curve.point(t)(coordinate); };
  std::vector<double> t(parts + 1), value(parts + 1);
  for (int i = 0; i <= parts; ++i) {
    t[i] = curve.begin() + (curve.end() - curve.begin()) * i / parts;
    value[i] = i == 0 ? ends[0] : i == parts ? ends[1] : at(t[i]);
  }
  for (int i = 0; i <= parts; ++i) {
    const int before = std::max(i - 1, 0), after = std::min(i + 1, parts);
    if (value[i] >= value[before] && value[i] >= value[after] && value[i] > range.low)
      range.high = std::max(
          {range.high, value[i], at(golden_section([&](double s) { return -at(s); }, t[before], t[after]))});
    if (value[i] <= value[before] && value[i] <= value[after] && value[i] < range.high)
      range.low = std::min({range.low, value[i], at(golden_section(at, t[before], t[after]))});
  }
  return range;
}

}  // namespace geometry_io
