// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/multi_patch_projector.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/assert.h"
#include "nurbs/curvature.h"

namespace search {
namespace {

constexpr double kNotFarther = 1.0 + 1e-14;  // of distances: round-off

}  // namespace

MultiPatchProjector::MultiPatchProjector(const MultiPatch& surface, const NodalVectors& control_points)
    : surface_(surface), control_points_(control_points) {
  if (control_points.cols() != surface.control_point_count())
    throw std::invalid_argument(fmt::format("{} control points given, expected {}", control_points.cols(),
                                            surface.control_point_count()));
  for (int p = 0; p < surface.patch_count(); ++p) {
    const nurbs::Space<2>& patch = surface.patch(p);
    const PatchPoints points(control_points, surface.first_control_point(p), patch.control_point_count());
    patches_.push_back(std::make_unique<SurfaceProjector>(patch, points));
  }
}

void MultiPatchProjector::surface_moved() {
  for (const std::unique_ptr<SurfaceProjector>& patch : patches_) patch->surface_moved();
}

void MultiPatchProjector::begin_list(double edge_angle) {
  const double smooth = std::max(edge_angle, SecondFoot::kFlush);
  goes_on_.resize(surface_.patch_count());
  for (int p = 0; p < surface_.patch_count(); ++p) {
    for (int side = 0; side < nurbs::kSideCount; ++side)
      goes_on_[p][side] =
          surface_.border(p, side).kind == nurbs::Border::welded && angle_now(p, side) <= smooth;
    patches_[p]->second_foot().begin_list(goes_on_[p], edge_angle);
  }
}

// Largest angle between the normals along a weld, where both patches have one: a flat plate of two patches
// has a kink once it is bent, as a weld keeps places alone.
double MultiPatchProjector::angle_now(int patch, int side) const {
  constexpr int kSamples = 4;  // per element
  const nurbs::Border& border = surface_.border(patch, side);
  const nurbs::KnotVector& along = surface_.patch(patch).knots(1 - side / 2);
  const double sign = nurbs::same_orientation(side, border) ? 1.0 : -1.0;
  double largest = 0.0;
  SurfacePoint at{patch, {}};
  at.xi[side / 2] = surface_.end_of_side(patch, side);
  for (int k = 0; k < kSamples * along.element_count(); ++k) {
    const double* knot = &along.breaks()[k / kSamples];
    at.xi[1 - side / 2] = knot[0] + (knot[1] - knot[0]) * (k % kSamples + 0.5) / kSamples;
    const Vector3 here = nurbs::shape_at(surface_, control_points_, at).normal;
    const Vector3 beyond =
        sign * nurbs::shape_at(surface_, control_points_, surface_.across(at, side)).normal;
    if (here.allFinite() && beyond.allFinite())
      largest = std::max(largest, std::atan2(here.cross(beyond).norm(), here.dot(beyond)));
  }
  return largest;
}

bool MultiPatchProjector::across_smooth_edge(const Foot& a, const Foot& b) const {
  if (a.patch != b.patch) {
    for (int side = 0; side < nurbs::kSideCount; ++side)
      if (goes_on_[a.patch][side] && surface_.border(a.patch, side).patch == b.patch) return true;
    return false;
  }
  for (int i = 0; i < 2; ++i) {
    const std::vector<double>& creases = surface_.patch(a.patch).knots(i).creases();
    const auto [low, high] = std::minmax(a.xi[i], b.xi[i]);
    const auto crease = std::upper_bound(creases.begin(), creases.end(), low);
    if (crease != creases.end() && *crease < high) return true;
  }
  return false;
}

// The local minimum reached on one patch.
Foot MultiPatchProjector::warm(const Vector3& d, const SurfacePoint& from, const Vector3& image) const {
  return placed(patches_[from.patch]->warm(d - image, from.xi), from.patch, image);
}

Foot MultiPatchProjector::follow(const Vector3& d, const SurfacePoint& from, const Vector3& image) const {
  return cross_borders(d, warm(d, from, image));
}

// Runs of feet on the same patch; those that end on an edge go on one by one.
void MultiPatchProjector::follow(const Vector3* d, Foot* const* feet, int count) const {
  for (int first = 0, end; first < count; first = end) {
    const int patch = feet[first]->patch;
    for (end = first + 1; end < count && feet[end]->patch == patch;) ++end;
    patches_[patch]->warm_batch(d + first, feet + first, end - first);
    for (int k = first; k < end; ++k)
      if (feet[k]->status != FootStatus::interior) *feet[k] = cross_borders(d[k], *feet[k]);
  }
}

Foot MultiPatchProjector::cross_borders(const Vector3& d, Foot foot) const {
  constexpr int kMaxCrossings = 16;  // in one step; each leads downhill
  Foot beyond;
  for (int crossing = 0; crossing < kMaxCrossings && leads_on(d, foot, beyond); ++crossing) foot = beyond;
  return foot;
}

// Whether the distance falls beyond a welded edge on which the foot lies, or on a patch around a pole where
// it lies; then where it falls to.
bool MultiPatchProjector::leads_on(const Vector3& d, const Foot& foot, Foot& beyond) const {
  if (foot.status == FootStatus::interior) return false;
  for (int side = 0; side < nurbs::kSideCount; ++side)
    if (surface_.border(foot.patch, side).kind == nurbs::Border::pole && surface_.on_side(foot.at(), side) &&
        leads_off_pole(d, foot, side, beyond))
      return true;
  for (int side = 0; side < nurbs::kSideCount; ++side) {
    const nurbs::Border& border = surface_.border(foot.patch, side);
    if (border.kind != nurbs::Border::welded || !surface_.on_side(foot.at(), side)) continue;
    const SurfacePoint start = surface_.across(foot.at(), side);
    const Vector3 image = foot.image + border.translation;
    beyond = warm(d, start, image);
    beyond.iterations += foot.iterations;
    const bool left = !surface_.on_side(beyond.at(), border.side);
    if (left && beyond.distance <= foot.distance * kNotFarther) return true;
  }
  return false;
}

// Goes round the pole from patch to patch, both ways if the patches do not close: a patch that leads downhill
// need not be the next one.
bool MultiPatchProjector::leads_off_pole(const Vector3& d, const Foot& foot, int pole, Foot& beyond) const {
  for (const int way : {0, 1}) {
    SurfacePoint corner = foot.at();
    Vector3 image = foot.image;
    int at_pole = pole, through = pole < 2 ? 2 + way : way;  // sides of corner.patch
    for (int turn = 0; turn < surface_.patch_count(); ++turn) {
      const nurbs::Border& border = surface_.border(corner.patch, through);
      if (border.kind != nurbs::Border::welded) break;
      corner.xi[through / 2] = surface_.end_of_side(corner.patch, through);
      corner = surface_.across(corner, through);
      image += border.translation;
      const int along = 1 - border.side / 2;
      at_pole = 2 * along + (corner.xi[along] == surface_.end_of_side(corner.patch, 2 * along + 1) ? 1 : 0);
      if (corner.patch == foot.patch && at_pole == pole) return false;  // all round
      beyond = warm(d, corner, image);
      beyond.iterations += foot.iterations;
      if (!surface_.on_side(beyond.at(), at_pole) && beyond.distance <= foot.distance * kNotFarther)
        return true;
      if (surface_.border(corner.patch, at_pole).kind != nurbs::Border::pole) break;
      through = border.side ^ 1;
    }
  }
  return false;
}

void MultiPatchProjector::add_minima(const Vector3& d, const Vector3& image, double reach, double same_foot,
                                     const int* elements, int count, std::vector<Foot>& out) const {
  const auto same = [&](const Foot& a, const Foot& b) {
    return (a.point - b.point).squaredNorm() <= same_foot * same_foot;
  };
  const auto known = [&](const Foot& foot) {
    return std::any_of(out.begin(), out.end(), [&](const Foot& other) { return same(foot, other); });
  };
  // A minimum near a border is that of the patch which it is inside of, not the end of the other one's way.
  // Within round-off it may seem to lie beyond from either side.
  const auto add = [&](const Foot& foot) {
    Foot beyond;
    const bool goes_on = leads_on(d, foot, beyond);
    if (!goes_on || same(foot, beyond)) out.push_back(goes_on ? beyond : foot);
  };
  const auto first_new = static_cast<std::ptrdiff_t>(out.size());
  for (int k = 0; k < count;) {
    NURBS_ASSERT(k == 0 || elements[k - 1] < elements[k], elements[k], k);
    const int p = surface_.patch_of_element(elements[k]);
    const int first = surface_.first_element(p), next = surface_.first_element(p + 1);
    patch_elements_.clear();
    for (; k < count && elements[k] < next; ++k) patch_elements_.push_back(elements[k] - first);
    patches_[p]->all_minima_on(d - image, reach, patch_elements_.data(),
                               static_cast<int>(patch_elements_.size()), found_);
    for (const Foot& on_patch : found_) {
      const Foot foot = placed(on_patch, p, image);
      if (!known(foot)) add(foot);
    }
  }
  std::sort(out.begin() + first_new, out.end(),
            [](const Foot& a, const Foot& b) { return a.distance < b.distance; });
}

}  // namespace search
