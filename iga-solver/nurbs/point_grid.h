// SPDX-License-Identifier: GPL-2.0-or-later
// Points by place: which of them are near another one, in a time that does not grow with their number.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nurbs/types.h"

namespace nurbs {

/// Points in the cells of a grid without bounds, found by a hash.
class PointGrid {
 public:
  /// Points are looked for within `tolerance` > 0 [length]; `count` is about how many there will be, `low`
  /// about where they are.
  PointGrid(double tolerance, std::size_t count, const Vector3& low = Vector3::Zero())
      : low_(low), tolerance_(tolerance) {
    int bits = 4;
    while ((std::size_t{1} << bits) < 2 * count) ++bits;
    head_.assign(std::size_t{1} << bits, kNone);
    shift_ = 64 - bits;
  }

  void add(int number, const Vector3& point) {
    int& head = head_[bucket(cell(point))];
    entries_.push_back({point, number, head});
    head = static_cast<int>(entries_.size()) - 1;
  }

  /// Calls f(number) for each point within the tolerance, in no order.
  template <class Function>
  void for_each_near(const Vector3& p, Function f) const {
    const Cell from = cell(p.array() - tolerance_), to = cell(p.array() + tolerance_);
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t k = from[2]; k <= to[2]; ++k) look_into({i, j, k}, p, f);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr int kNone = -1;
  // Wide enough for most points to look into one cell or two.
  static constexpr double kCellPerTolerance = 8.0;

  struct Entry {
    Vector3 point;
    int number, next;  // of the same bucket
  };

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
  // A bucket may hold points of other cells too: these are seen from their own.
  template <class Function>
  void look_into(const Cell& at, const Vector3& p, Function f) const {
    for (int e = head_[bucket(at)]; e != kNone; e = entries_[e].next)
      if ((entries_[e].point - p).norm() <= tolerance_ && cell(entries_[e].point) == at)
        f(entries_[e].number);
  }

  Vector3 low_;
  double tolerance_;
  std::vector<int> head_;  // of each bucket its latest entry
  int shift_;
  std::vector<Entry> entries_;
};

}  // namespace nurbs
