// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/time_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace structure {

namespace {

using Row = std::array<double, 2>;

double interpolate(const std::vector<Row>& rows, double t) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), t,
                                      [](double time, const Row& row) { return time < row[0]; });
  if (after == rows.begin()) return rows.front()[1];
  if (after == rows.end()) return rows.back()[1];
  const Row &low = *(after - 1), &high = *after;
  const double part = (t - low[0]) / (high[0] - low[0]);
  return (1.0 - part) * low[1] + part * high[1];
}

}  // namespace

TimeFunction ramp(double from, double to) { return table({{from, 0.0}, {to, 1.0}}); }

TimeFunction sine(double frequency, double phase) {
  const double omega = 2.0 * std::acos(-1.0) * frequency;
  return [=](double t) { return std::sin(omega * t + phase); };
}

TimeFunction table(std::vector<Row> rows) {
  if (rows.empty()) throw std::invalid_argument("no rows, expected [t, value], ...");
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (!(rows[i - 1][0] < rows[i][0]))
      throw std::invalid_argument(
          fmt::format("time {} follows {}, expected rising times", rows[i][0], rows[i - 1][0]));
  return [rows = std::move(rows)](double t) { return interpolate(rows, t); };
}

}  // namespace structure
