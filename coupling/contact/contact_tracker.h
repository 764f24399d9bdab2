// SPDX-License-Identifier: GPL-2.0-or-later
// The feet of candidates on a wall of patches.
//
// When the list is new, all minima within its reach are found by branch and bound.  Where a second foot is
// excluded (search/second_foot.h) none can appear or vanish until the next rebuild, so each is followed from
// its last place. Elsewhere - edges, kinks, poles, troughs as narrow as the particle - all minima are found
// anew in each step.
#pragma once

#include <vector>

#include "coupling/contact/feet_tracker.h"
#include "coupling/contact/local_search.h"

namespace contact {

class ContactTracker final : public FeetTracker {
 public:
  /// Keeps a reference to the candidates and those of the search.  `edge_angle`: edges that turn by no more
  /// are smooth [rad].
  ContactTracker(const LocalSearch& search, const CandidateList& candidates, double edge_angle)
      : FeetTracker(candidates), search_(search), edge_angle_(edge_angle) {}

  void list_is_new() override;
  void follow(Query* queries, int count) override;
  FeetRange feet(const Query& query, const ParticleSlots& slots) override {
    const State& state = states_[query.candidate];
    if (!state.regular) return find_feet(query, slots);
    const FeetRange feet{feet_.data() + state.first, state.count};
    keep_clearance(query, nearest_distance(feet, query));
    return feet;
  }

 private:
  struct State {
    int first = 0, count = 0;  // range in feet_
    bool is_new = true, regular = false, touched = false;
  };
  FeetRange find_feet(const Query& query, const ParticleSlots& slots);
  bool is_regular(const Candidate& candidate, const Query& query) const;
  void find_all(const Candidate& candidate, const Query& query, double reach, const ParticleSlots& slots,
                std::vector<TrackedFoot>& out);
  bool in_valley(const Query& query, const search::Foot& foot) const;
  void keep_one_of_each_valley(const Query& query);
  bool repeats_across_smooth_edge(const Query& query, const search::Foot& foot,
                                  const search::Foot& nearer) const;
  void keep_nearer_across_smooth_edges(const Query& query);
  void match_slots(const Query& query, const ParticleSlots& slots, TrackedFoot* feet, int count);
  void keep_feet_of_all_images(const Query& query);
  nurbs::Vector3 nearest_image(const nurbs::SurfacePoint& at, const nurbs::Vector3& centre) const;

  LocalSearch search_;
  double edge_angle_;
  std::vector<State> states_;          // per candidate
  std::vector<TrackedFoot> feet_;      // of regular candidates
  std::vector<TrackedFoot> all_feet_;  // of one that is not, this step
  std::vector<search::Foot> found_, of_image_, beside_;
};

}  // namespace contact
