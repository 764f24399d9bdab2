// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/contact_tracker.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nurbs/assert.h"
#include "nurbs/curvature.h"

namespace contact {

using nurbs::SurfacePoint;
using nurbs::Vector3;
using search::Foot;

namespace {

constexpr double kSameFoot = 1e-6;  // of the reach: feet closer than this are one contact

bool same(const Foot& a, const Foot& b, double reach) {
  return (a.point - b.point).squaredNorm() <= kSameFoot * kSameFoot * reach * reach;
}

}  // namespace

void ContactTracker::list_is_new() {
  FeetTracker::list_is_new();
  states_.assign(candidates_.candidates().size(), State());
  feet_.clear();
}

void ContactTracker::follow(Query* queries, int count) {
  constexpr int kMost = 64;
  Foot* feet[kMost];
  Vector3 centres[kMost];
  int n = 0;
  for (const Query* query = queries; query < queries + count; ++query) {
    NURBS_ASSERT(query->candidate < static_cast<int>(states_.size()), query->candidate, states_.size());
    const State& state = states_[query->candidate];
    NURBS_ASSERT(state.first + state.count <= static_cast<int>(feet_.size()), state.first, state.count);
    for (int k = 0; k < state.count; ++k) {
      if (n == kMost) search_.advance(centres, feet, n), n = 0;
      feet[n] = &feet_[state.first + k].foot;
      centres[n++] = query->centre;
    }
  }
  search_.advance(centres, feet, n);
}

// Of a candidate whose branches are not followed, or not yet.
FeetRange ContactTracker::find_feet(const Query& query, const ParticleSlots& slots) {
  NURBS_ASSERT(states_.size() == candidates_.candidates().size(), states_.size());
  const Candidate& candidate = candidates_.candidates()[query.candidate];
  State& state = states_[query.candidate];
  find_all(candidate, query, state.touched ? query.touch_reach : query.list_reach, slots, all_feet_);
  FeetRange feet{all_feet_.data(), static_cast<int>(all_feet_.size())};
  if (state.is_new) {
    state.is_new = false;
    state.regular = is_regular(candidate, query);
    if (state.regular) {
      state.first = static_cast<int>(feet_.size());
      state.count = feet.count;
      feet_.insert(feet_.end(), feet.begin(), feet.end());
      feet.first = feet_.data() + state.first;
    }
  }
  // A search within touch_reach does not tell how far the surface is.
  const double clearance = nearest_distance(feet, query);
  keep_clearance(query, state.touched && !state.regular ? 0.0 : clearance);
  state.touched = clearance < query.touch_reach;
  return feet;
}

bool ContactTracker::is_regular(const Candidate& candidate, const Query& query) const {
  const ImageElements* images = candidates_.image_elements(candidate);
  for (int k = 0; k < candidate.image_count; ++k) {
    const Vector3 d = query.centre - candidates_.images()[images[k].image];
    const int* elements = candidates_.elements(images[k]);
    for (int e = 0; e < images[k].count; ++e)
      if (!search_.projector().excludes_second_foot(d, query.list_reach, elements[e])) return false;
  }
  return true;
}

void ContactTracker::find_all(const Candidate& candidate, const Query& query, double reach,
                              const ParticleSlots& slots, std::vector<TrackedFoot>& out) {
  found_.clear();
  const ImageElements* images = candidates_.image_elements(candidate);
  for (int k = 0; k < candidate.image_count; ++k) {
    of_image_.clear();
    search_.add_minima(query.centre, candidates_.images()[images[k].image], reach,
                       kSameFoot * query.touch_reach, candidates_.elements(images[k]), images[k].count,
                       of_image_);
    found_.insert(found_.end(), of_image_.begin(), of_image_.end());
  }
  if (candidate.image_count > 1) keep_feet_of_all_images(query);
  keep_one_of_each_valley(query);
  keep_nearer_across_smooth_edges(query);
  out.clear();
  for (const Foot& foot : found_) out.push_back({foot, -1});
  match_slots(query, slots, out.data(), static_cast<int>(out.size()));
}

void ContactTracker::keep_feet_of_all_images(const Query& query) {
  FeetTracker::keep_feet_of_all_images(query, found_, [&](const Foot& foot, const ImageElements& at) {
    beside_.clear();
    search_.projector().add_minima(foot.point, candidates_.images()[at.image], same_place(query), 0.0,
                                   candidates_.elements(at), at.count, beside_);
    return !beside_.empty();
  });
}

// Whether the distance does not rise along the surface to second order, as the particle is on a centre of
// curvature.  Of a pole counts what is beside it.
bool ContactTracker::in_valley(const Query& query, const Foot& foot) const {
  constexpr double kFlat = 1e-6;
  const search::SurfaceProjector& patch = search_.projector().patch(foot.patch);
  const nurbs::SurfaceShape shape = nurbs::shape_near(patch.space(), patch.control_points(), foot.xi);
  const double side = shape.normal.dot(query.centre - foot.image - shape.point) < 0.0 ? -1.0 : 1.0;
  const auto flat = [&](double curvature) {
    return std::abs(1.0 - side * foot.distance * curvature) <= kFlat;
  };
  return flat(shape.curvature[0]) || flat(shape.curvature[1]);
}

// On a centre of curvature (the axis of a tube) feet are not isolated and the search finds some of a row of
// them, all equally far: they are one contact.
void ContactTracker::keep_one_of_each_valley(const Query& query) {
  constexpr double kEqual = 1e-9;
  if (found_.size() < 2) return;
  const auto repeats = [&](const Foot& foot, const Foot& kept) {
    return std::abs(foot.distance - kept.distance) <= kEqual * foot.distance && in_valley(query, kept) &&
           in_valley(query, foot);
  };
  auto end = found_.begin() + 1;
  for (auto foot = end; foot != found_.end(); ++foot)
    if (std::none_of(found_.begin(), end, [&](const Foot& kept) { return repeats(*foot, kept); }))
      *end++ = *foot;
  found_.erase(end, found_.end());
}

// In a kink that counts as smooth there are two feet, side by side, where a smooth surface has one.
bool ContactTracker::repeats_across_smooth_edge(const Query& query, const Foot& foot,
                                                const Foot& nearer) const {
  const auto to_centre = [&](const Foot& f) { return Vector3((query.centre - f.point).normalized()); };
  const auto angle = [](const Vector3& a, const Vector3& b) {  // 0 to pi, as edge_angle
    return std::atan2(a.cross(b).norm(), a.dot(b));
  };
  return (foot.point - nearer.point).norm() <= 2.0 * edge_angle_ * foot.distance &&
         angle(to_centre(foot), to_centre(nearer)) <= edge_angle_ &&
         search_.projector().across_smooth_edge(foot, nearer);
}

void ContactTracker::keep_nearer_across_smooth_edges(const Query& query) {
  const auto repeats = [&](const Foot& foot, const Foot& nearer) {
    return (nearer.distance < foot.distance || (nearer.distance == foot.distance && &nearer < &foot)) &&
           repeats_across_smooth_edge(query, foot, nearer);
  };
  for (auto foot = found_.begin(); foot != found_.end();)
    if (std::any_of(found_.begin(), found_.end(), [&](const Foot& nearer) { return repeats(*foot, nearer); }))
      foot = found_.erase(foot);
    else
      ++foot;
}

// A slot goes with its branch: to the foot that is reached from where the branch was last, or in a kink that
// counts as smooth to the one that is nearer now.
void ContactTracker::match_slots(const Query& query, const ParticleSlots& slots, TrackedFoot* feet,
                                 int count) {
  for (int s = 0; s < slots.used(); ++s) {
    ContactSlot slot = slots.slot(s);
    if (slot.empty()) continue;
    const SurfacePoint last = slot.foot();
    const Foot now = search_.projector().follow(query.centre, last, nearest_image(last, query.centre));
    TrackedFoot* const end = feet + count;
    TrackedFoot* found =
        std::find_if(feet, end, [&](const TrackedFoot& f) { return same(f.foot, now, query.touch_reach); });
    if (found == end)
      found = std::find_if(
          feet, end, [&](const TrackedFoot& f) { return repeats_across_smooth_edge(query, now, f.foot); });
    if (found != end && found->slot < 0)
      found->slot = s;
    else
      slot.clear();  // out of reach, or grown together with another branch
  }
}

// The one on which the point `at` is nearest to the centre; it may be left out of the list, as another
// repeats it.
Vector3 ContactTracker::nearest_image(const SurfacePoint& at, const Vector3& centre) const {
  const std::vector<Vector3>& images = candidates_.images();
  if (images.size() == 1) return images.front();
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(search_.projector().surface(), at, 0, basis);
  const Vector3 S = nurbs::interpolate(basis, search_.projector().control_points());
  return *std::min_element(images.begin(), images.end(), [&](const Vector3& a, const Vector3& b) {
    return (S + a - centre).squaredNorm() < (S + b - centre).squaredNorm();
  });
}

}  // namespace contact
