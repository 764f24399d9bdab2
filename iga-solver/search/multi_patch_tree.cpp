// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/multi_patch_tree.h"

#include <cmath>

namespace search {

void MultiPatchTree::build(const MultiPatch& surface, const NodalVectors& control_points) {
  trees_.clear();
  first_element_.clear();
  patches_.assign((surface.patch_count() + kLanes - 1) / kLanes, BoxLanes<kLanes>());
  bounds_ = {control_points.rowwise().minCoeff(), control_points.rowwise().maxCoeff()};
  units_.set(bounds_.low, bounds_.high);
  for (int p = 0; p < surface.patch_count(); ++p) {
    const auto points = surface.control_points_of(p, control_points);
    trees_.emplace_back(surface.patch(p)).refit(points);
    first_element_.push_back(surface.first_element(p));
    patches_[p / kLanes].set(p % kLanes, units_.in_units(points.rowwise().minCoeff()),
                             units_.in_units(points.rowwise().maxCoeff()));
  }
}

void MultiPatchTree::query(const Vector3& point, double reach, std::vector<int>& out) const {
  const BoxUnits::Point at = units_.point(point);
  if (!std::isfinite(at.far)) return;
  const float limit = units_.limit_with(at, reach);
  for (size_t block = 0; block < patches_.size(); ++block) {
    const unsigned near = SurfaceTree::below(patches_[block].near2(at), limit);
    for (int lane = 0; near >> lane != 0; ++lane) {
      const size_t p = kLanes * block + lane;
      if (near >> lane & 1) trees_[p].query(point, reach, first_element_[p], out);
    }
  }
}

}  // namespace search
