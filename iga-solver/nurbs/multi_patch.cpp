// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/multi_patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "nurbs/assert.h"

namespace nurbs {

MultiPatch::MultiPatch(std::vector<Space<2>> patches, Borders borders) : patches_(std::move(patches)) {
  if (patches_.empty()) throw std::invalid_argument("a surface of 0 patches, expected at least 1");
  set_borders(borders.empty() ? Borders(patches_.size()) : std::move(borders));
  first_control_point_ = first_element_ = {0};
  for (const Space<2>& patch : patches_) {
    first_control_point_.push_back(first_control_point_.back() + patch.control_point_count());
    first_element_.push_back(first_element_.back() + patch.element_count());
  }
}

void MultiPatch::set_borders(Borders borders) {
  if (borders.size() != patches_.size())
    throw std::invalid_argument(
        fmt::format("borders of {} patches given, expected {}", borders.size(), patches_.size()));
  borders_ = std::move(borders);
}

int MultiPatch::patch_of_element(int element) const {
  NURBS_ASSERT(0 <= element && element < element_count(), element, element_count());
  const auto beyond = std::upper_bound(first_element_.begin(), first_element_.end(), element);
  return static_cast<int>(beyond - first_element_.begin()) - 1;
}

SurfacePoint MultiPatch::across(const SurfacePoint& point, int side) const {
  NURBS_ASSERT(0 <= point.patch && point.patch < patch_count(), point.patch, patch_count());
  NURBS_ASSERT(0 <= side && side < kSideCount, side);
  const Border& border = borders_[point.patch][side];
  NURBS_ASSERT(border.kind == Border::welded, point.patch, side);
  NURBS_ASSERT(on_side(point, side), side, point.xi[0], point.xi[1]);
  const KnotVector& here = patches_[point.patch].knots(1 - side / 2);
  const int along = 1 - border.side / 2;
  const KnotVector& there = patches_[border.patch].knots(along);
  const KnotVector& beyond = patches_[border.patch].knots(1 - along);
  const double t = (point.xi[1 - side / 2] - here.front()) / (here.back() - here.front());
  SurfacePoint result{border.patch, {}};
  const double from_start = border.reversed ? 1.0 - t : t;
  result.xi[along] =
      from_start == 1.0 ? there.back() : there.front() + from_start * (there.back() - there.front());
  result.xi[1 - along] = border.side % 2 == 1 ? beyond.back() : beyond.front();
  return result;
}

PatchedSurface join(const std::vector<Surface>& patches) {
  std::vector<Space<2>> spaces;
  for (const Surface& patch : patches) spaces.push_back(patch.space);
  PatchedSurface surface{MultiPatch(std::move(spaces), find_borders(patches)), {}};
  surface.control_points.resize(3, surface.topology.control_point_count());
  for (int p = 0; p < surface.topology.patch_count(); ++p)
    surface.control_points.middleCols(surface.topology.first_control_point(p),
                                      patches[p].control_points.cols()) = patches[p].control_points;
  return surface;
}

std::vector<Surface> split(const MultiPatch& topology, const NodalVectors& control_points) {
  NURBS_ASSERT(control_points.cols() == topology.control_point_count(), control_points.cols());
  std::vector<Surface> patches;
  for (int p = 0; p < topology.patch_count(); ++p)
    patches.push_back({topology.patch(p), topology.control_points_of(p, control_points)});
  return patches;
}

void evaluate(const MultiPatch& surface, const SurfacePoint& at, int derivatives, RationalBasis<2>& out) {
  evaluate(surface.patch(at.patch), at.xi, derivatives, out);
  const int first = surface.first_control_point(at.patch);
  for (int a = 0; a < out.count; ++a) out.control_point[a] += first;
}

}  // namespace nurbs
