// SPDX-License-Identifier: GPL-2.0-or-later
// Which pieces of a wall are near a point, remembered for cells of space: particles come to the same places
// again and again, and most are far from every wall or near a few faces.
#pragma once

#include <cstdint>
#include <vector>

#include "brep/foot_search.h"

namespace brep {

class NearCells {
 public:
  /// Keeps a reference.  When lists of more pieces than `most` are remembered, all are forgotten.
  explicit NearCells(const FootSearch& search, std::size_t most = 1 << 24) : search_(search), most_(most) {}

  /// As FootSearch::near.
  void near(const Vector3& d, double reach, std::vector<int>& pieces);

 private:
  // Cells for all reaches of one half octave, as wide as the largest of these at least.
  struct Grid {
    double reach = 0.0, width = 0.0;  // [length]
    Vector3 low;
    std::int64_t count[3]{};
    std::vector<std::int32_t> lists;  // of each cell: where its list begins, or one of these:
  };
  static constexpr std::int32_t kNotYet = -1, kMany = -2, kEmpty = 0;
  Grid& grid_for(double reach);
  static std::int64_t cell_of(const Grid& grid, const Vector3& d);
  std::int32_t list_of(Grid& grid, std::int64_t cell);

  void forget();

  const FootSearch& search_;
  std::size_t most_;
  std::vector<Grid> grids_;       // by level
  int first_level_ = 0;           // of grids_
  std::vector<int> lists_ = {0};  // each begins with its length; the first is empty
  std::vector<int> found_;        // of one cell
};

}  // namespace brep
