// SPDX-License-Identifier: GPL-2.0-or-later
// Points that stand at the same place, by a hash of the cells of a grid.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "brep/names.h"

namespace brep {

class PointHash {
 public:
  /// Points nearer than `tolerance` [length] are the same.
  explicit PointHash(double tolerance) : tolerance_(tolerance) {}

  /// Number of a point; a new one unless it is known.
  int number(const Vector3& x) {
    const Cell at = cell(x);
    for (int k = 0; k < 27; ++k) {
      const auto found = first_.find({at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1});
      if (found == first_.end()) continue;
      for (const int i : found->second)
        if ((points_[i] - x).norm() <= tolerance_) return i;
    }
    first_[at].push_back(static_cast<int>(points_.size()));
    points_.push_back(x);
    return static_cast<int>(points_.size()) - 1;
  }
  const std::vector<Vector3>& points() const { return points_; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell(const Vector3& x) const {
    Cell at;
    for (int i = 0; i < 3; ++i) at[i] = static_cast<std::int64_t>(std::floor(x[i] / tolerance_));
    return at;
  }

  double tolerance_;
  std::map<Cell, std::vector<int>> first_;
  std::vector<Vector3> points_;
};

}  // namespace brep
