// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/coincident.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace nurbs {
namespace {

using Points = Eigen::Ref<const NodalVectors>;
using Cell = std::array<std::int64_t, 3>;

constexpr int kNone = -1;

// Points that stand for others, in the cells of a grid.  They are further apart than the tolerance, so that a
// cell holds a bounded number, however many points there are.
class PointGrid {
 public:
  PointGrid(const Points& points, const Vector3& low, double tolerance)
      : points_(points), low_(low), tolerance_(tolerance), next_(points.cols(), kNone) {
    int bits = 4;
    while ((std::int64_t{1} << bits) < 2 * points.cols()) ++bits;
    head_.assign(std::size_t{1} << bits, kNone);
    shift_ = 64 - bits;
  }

  void add(int point) {
    int& head = head_[bucket(cell(points_.col(point)))];
    next_[point] = head;
    head = point;
  }

  // The lowest of those within the tolerance, or `point`.
  int lowest_near(int point) const {
    const Vector3 p = points_.col(point);
    const Cell from = cell(p.array() - tolerance_), to = cell(p.array() + tolerance_);
    int lowest = point;
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t k = from[2]; k <= to[2]; ++k)
          for (int other = head_[bucket({i, j, k})]; other != kNone; other = next_[other])
            if (other < lowest && (points_.col(other) - p).norm() <= tolerance_) lowest = other;
    return lowest;
  }

 private:
  // Wide enough for most points to look into one cell or two.
  static constexpr double kCellPerTolerance = 8.0;

  Cell cell(const Vector3& p) const {
    Cell cell;
    for (int d = 0; d < 3; ++d) cell[d] = std::llround((p[d] - low_[d]) / (kCellPerTolerance * tolerance_));
    return cell;
  }
  std::size_t bucket(const Cell& cell) const {  // Knuth's multiplicative hashing, odd factors
    const std::uint64_t sum = static_cast<std::uint64_t>(cell[0]) * 0x9E3779B97F4A7C15u +
                              static_cast<std::uint64_t>(cell[1]) * 0xC2B2AE3D27D4EB4Fu +
                              static_cast<std::uint64_t>(cell[2]) * 0x165667B19E3779F9u;
    return (sum ^ (sum >> 29)) * 0xBF58476D1CE4E5B9u >> shift_;
  }

  const Points& points_;
  Vector3 low_;
  double tolerance_;
  std::vector<int> head_, next_;  // of each bucket its latest point, of each point the one before it
  int shift_;
};

}  // namespace

std::vector<int> first_coincident(const Points& points, double relative_tolerance) {
  const int count = static_cast<int>(points.cols());
  std::vector<int> first(count, 0);
  if (count == 0) return first;
  const Vector3 low = points.rowwise().minCoeff();
  const double tolerance = relative_tolerance * (points.rowwise().maxCoeff() - low).stableNorm();
  if (tolerance == 0.0) return first;  // all are one
  PointGrid grid(points, low, tolerance);
  for (int i = 0; i < count; ++i)
    if ((first[i] = grid.lowest_near(i)) == i) grid.add(i);
  return first;
}

}  // namespace nurbs
