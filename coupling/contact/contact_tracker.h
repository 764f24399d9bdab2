// SPDX-License-Identifier: GPL-2.0-or-later
// The feet of each candidate from step to step: all local minima of the distance within reach, each with the
// slot of the particle's memory that belongs to its branch.
//
// When the list is new, all minima within its reach are found by branch and bound.  Where a second foot is
// excluded (search/second_foot.h) none can appear or vanish until the next rebuild, so each is followed from
// its last place. Elsewhere - edges, kinks, poles, troughs as narrow as the particle - all minima are found
// anew in each step.
#pragma once

#include <algorithm>
#include <vector>

#include "coupling/contact/candidate_list.h"
#include "coupling/contact/contact_memory.h"
#include "coupling/contact/local_search.h"

namespace contact {

struct TrackedFoot {
  search::Foot foot;
  int slot;  ///< of the particle's memory; -1: none yet
};
struct FeetRange {
  TrackedFoot* first;
  int count;
  TrackedFoot* begin() const { return first; }
  TrackedFoot* end() const { return first + count; }
};

class ContactTracker {
 public:
  /// Keeps references to both.
  ContactTracker(LocalSearch& search, const CandidateList& candidates)
      : search_(search), candidates_(candidates) {}

  /// After the list was rebuilt.
  void list_is_new();
  /// `surface_motion`: how far a deforming wall has moved since the list was built, else 0 [length].
  void begin_step(double surface_motion) { surface_motion_ = surface_motion; }

  /// A candidate of this step: where it is, and how far its contacts and its list reach [length].
  struct Query {
    int candidate;          ///< its number in the list
    nurbs::Vector3 centre;  ///< in the frame of the control points
    double touch_reach;     ///< feet nearer than this may touch
    double list_reach;      ///< feet nearer than this may do so before the next rebuild
  };
  /// Whether nothing within `touch_reach` can touch a candidate: too little has moved or grown since its feet
  /// were found last.
  bool is_quiet(int candidate, const nurbs::Vector3& centre, double touch_reach) const {
    const State& state = states_[candidate];
    const double allowance = state.clearance - touch_reach - (surface_motion_ + state.surface_motion);
    return allowance > 0.0 && (centre - state.centre).squaredNorm() < allowance * allowance;
  }
  /// Takes the branches of these candidates to where they are now, as far as they are followed.
  void follow(const Query* queries, int count);
  /// The feet of a candidate, after follow(); those nearer than touch_reach are complete.  `slots`
  /// whose branches are gone are cleared.  Valid until the next call.
  FeetRange feet(const Query& query, const ParticleSlots& slots) {
    State& state = states_[query.candidate];
    if (!state.regular) return find_feet(query, slots);
    const FeetRange feet{feet_.data() + state.first, state.count};
    keep_clearance(query, nearest_distance(feet, query), state);
    return feet;
  }

 private:
  struct State {
    int first = 0, count = 0;  // range in feet_
    bool is_new = true, regular = false, touched = false;
    nurbs::Vector3 centre = nurbs::Vector3::Zero();  // at the last search
    double clearance = 0.0;  // no point of the surface was nearer then; 0: one touched
    double surface_motion = 0.0;
  };
  static double nearest_distance(const FeetRange& feet, const Query& query) {
    double nearest = query.list_reach;
    for (const TrackedFoot& f : feet) nearest = std::min(nearest, f.foot.distance);
    return nearest;
  }
  void keep_clearance(const Query& query, double clearance, State& state) const {
    const bool touches = clearance <= query.touch_reach;
    state.clearance = touches ? 0.0 : clearance;  // contacts are looked at until they have ended
    if (touches) return;
    state.centre = query.centre;
    state.surface_motion = surface_motion_;
  }
  FeetRange find_feet(const Query& query, const ParticleSlots& slots);
  bool is_regular(const Candidate& candidate, const Query& query) const;
  void find_all(const Candidate& candidate, const Query& query, double reach, const ParticleSlots& slots,
                std::vector<TrackedFoot>& out);
  bool in_valley(const Query& query, const search::Foot& foot) const;
  void keep_one_of_each_valley(const Query& query);
  void match_slots(const Candidate& candidate, const Query& query, const ParticleSlots& slots,
                   TrackedFoot* feet, int count);
  nurbs::Vector3 nearest_image(const Candidate& candidate, const nurbs::SurfacePoint& at,
                               const nurbs::Vector3& centre) const;

  LocalSearch& search_;
  const CandidateList& candidates_;
  std::vector<State> states_;          // per candidate
  std::vector<TrackedFoot> feet_;      // of regular candidates
  std::vector<TrackedFoot> all_feet_;  // of one that is not, this step
  std::vector<search::Foot> found_;
  double surface_motion_ = 0.0;
};

}  // namespace contact
