// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/near_cells.h"

#include <algorithm>
#include <cmath>

namespace brep {
namespace {

constexpr int kFewPieces = 32;                // beyond that the tree is quicker, and lists would be long
constexpr std::int64_t kMostCells = 1 << 20;  // of one grid
// Of the wall's size: cells tell nothing of shorter or longer reaches; where a cell ends.
constexpr double kShortReach = 1e-3, kLongReach = 1.0, kEndOfCell = 1e-12;

// The least n with reach <= 2^(n / 2).
int level_of(double reach) {
  constexpr double kRootOfHalf = 0.70710678118654752;
  int exponent;
  const double mantissa = std::frexp(reach, &exponent);  // in [1/2, 1)
  return 2 * exponent - static_cast<int>(mantissa <= kRootOfHalf);
}

}  // namespace

void NearCells::near(const Vector3& d, double reach, std::vector<int>& pieces) {
  const double size = search_.surface().size;
  if (!(reach > kShortReach * size && reach < kLongReach * size)) return search_.near(d, reach, pieces);
  if (lists_.size() > most_) forget();
  Grid& grid = grid_for(reach);
  const std::int64_t cell = cell_of(grid, d);
  if (cell < 0) return;
  const std::int32_t list = list_of(grid, cell);
  if (list == kMany) return search_.near(d, reach, pieces);
  const int count = lists_[list];
  if (count == 0) return;
  const std::size_t before = pieces.size();
  pieces.resize(before + count);
  pieces.resize(before + search_.activate(d, reach, &lists_[list + 1], count, &pieces[before]));
}

void NearCells::forget() {
  grids_.clear();
  lists_.assign(1, 0);
}

NearCells::Grid& NearCells::grid_for(double reach) {
  const Surface& surface = search_.surface();
  const int level = level_of(reach);
  if (grids_.empty()) first_level_ = level;
  if (level < first_level_) {
    grids_.insert(grids_.begin(), first_level_ - level, Grid());
    first_level_ = level;
  }
  if (level - first_level_ >= static_cast<int>(grids_.size())) grids_.resize(level - first_level_ + 1);
  Grid& grid = grids_[level - first_level_];
  if (!grid.lists.empty()) return grid;
  grid.reach = std::exp2(0.5 * level) * (1.0 + kEndOfCell);
  const double round_off = kEndOfCell * surface.size;
  grid.low = surface.low.array() - grid.reach - round_off;
  const Vector3 extent = (surface.high - surface.low).array() + 2.0 * (grid.reach + round_off);
  grid.width = std::max(grid.reach, std::cbrt(extent.prod() / static_cast<double>(kMostCells)));
  for (int i = 0; i < 3; ++i) grid.count[i] = static_cast<std::int64_t>(extent[i] / grid.width) + 1;
  grid.lists.assign(grid.count[0] * grid.count[1] * grid.count[2], kNotYet);
  return grid;
}

// -1: nothing is within its reach.
inline std::int64_t NearCells::cell_of(const Grid& grid, const Vector3& d) {
  std::int64_t at[3];
  for (int i = 0; i < 3; ++i) {
    const double place = (d[i] - grid.low[i]) / grid.width;
    if (!(place >= 0.0 && place < static_cast<double>(grid.count[i]))) return -1;
    at[i] = static_cast<std::int64_t>(place);
  }
  return (at[2] * grid.count[1] + at[1]) * grid.count[0] + at[0];
}

std::int32_t NearCells::list_of(Grid& grid, std::int64_t cell) {
  std::int32_t& list = grid.lists[cell];
  if (list != kNotYet) return list;
  const std::int64_t at[3] = {cell % grid.count[0], cell / grid.count[0] % grid.count[1],
                              cell / grid.count[0] / grid.count[1]};
  Vector3 centre;
  for (int i = 0; i < 3; ++i) centre[i] = grid.low[i] + grid.width * (static_cast<double>(at[i]) + 0.5);
  const double half_diagonal = 0.5 * std::sqrt(3.0) * grid.width + kEndOfCell * search_.surface().size;
  found_.clear();
  search_.near(centre, grid.reach + half_diagonal, found_);
  const int count = static_cast<int>(found_.size());
  if (count > kFewPieces) return list = kMany;
  if (count == 0) return list = kEmpty;
  list = static_cast<std::int32_t>(lists_.size());
  lists_.push_back(count);
  lists_.insert(lists_.end(), found_.begin(), found_.end());
  return list;
}

}  // namespace brep
