// SPDX-License-Identifier: GPL-2.0-or-later
// The feet of each candidate from step to step: all local minima of the distance within reach, each with the
// slot of the particle's memory that belongs to its branch.  Of a wall of patches by contact_tracker.h, of
// one of faces in closed form by face_tracker.h; what both do: particles that too little has moved to touch
// are left out.
#pragma once

#include <algorithm>
#include <vector>

#include "coupling/contact/candidate_list.h"
#include "coupling/contact/contact_memory.h"
#include "coupling/contact/steady_feet.h"
#include "nurbs/processor.h"
#include "search/foot.h"

namespace contact {

struct TrackedFoot {
  search::Foot foot;
  int slot;       ///< of the particle's memory; -1: none yet
  int side = 0;   ///< of the surface that the centre is on, as ContactSlot::side(); 0: nobody has looked
  int face = -1;  ///< on a wall of faces: its number, of a patch that is cut that of the part
};
struct FeetRange {
  TrackedFoot* first;
  int count;
  TrackedFoot* begin() const { return first; }
  TrackedFoot* end() const { return first + count; }
};

class FeetTracker {
 public:
  /// Keeps a reference.
  explicit FeetTracker(const CandidateList& candidates) : candidates_(candidates) {}
  virtual ~FeetTracker() = default;

  /// After the list was rebuilt.
  virtual void list_is_new() {
    quiet_.swap(quiet_before_);
    quiet_.assign(candidates_.candidates().size(), Quiet());
  }
  /// Particles as the list was built, by their number: tag, centre in space, how far it looked [length].
  struct Listed {
    const int* tag;
    const double *x, *reach;
  };
  /// After that: what was known of candidates, and still holds, need not be found out again.
  virtual void go_on(const Listed& /*particles*/) {}
  /// `surface_motion`: how far a deforming wall has moved since the list was built, else 0 [length].
  void begin_step(double surface_motion) { surface_motion_ = surface_motion; }

  /// A candidate of this step: where it is, and how far its contacts and its list reach [length].
  struct Query {
    int candidate, particle;  ///< numbers in their lists
    nurbs::Vector3 centre;    ///< in the wall's frame
    double touch_reach;       ///< feet nearer than this may touch
    double list_reach;        ///< feet nearer than this may do so before the next rebuild
    double squared_travel;    ///< how far it and the wall move in a step, at most, squared [length^2]

    /// It may come to the surface within a step from farther than it touches.
    bool is_fast() const { return squared_travel > touch_reach * touch_reach; }
  };
  static constexpr int kBlock = 64;  ///< queries that are followed together, at most
  /// Candidates that are best taken together.
  int block() { return steady() ? SteadyFeet::kBlock : kBlock; }
  /// Whether nothing within `touch_reach` can touch a candidate: too little has moved or grown since its feet
  /// were found last.
  bool is_quiet(int candidate, const nurbs::Vector3& centre, double touch_reach) const {
    const Quiet& quiet = quiet_[candidate];
    const double allowance = quiet.clearance - touch_reach - (surface_motion_ + quiet.surface_motion);
    return allowance > 0.0 && (centre - quiet.centre).squaredNorm() < allowance * allowance;
  }
  /// Has the processor fetch what that is seen by.
  void prefetch_quiet(int candidate) const { nurbs::prefetch(quiet_[candidate]); }
  /// Candidates whose feet need no search: ask these before anything else; null: none ever.
  virtual SteadyFeet* steady() { return nullptr; }
  /// Takes the branches of these candidates to where they are now, as far as they are followed.
  virtual void follow(Query* queries, int count) = 0;
  /// The feet of a candidate, after follow(); those nearer than touch_reach are complete.
  /// `slots` whose branches are gone are cleared.  Valid until the next call.
  virtual FeetRange feet(const Query& query, const ParticleSlots& slots) = 0;

 protected:
  /// Points of two images that are not farther apart are one [length].
  static double same_place(const Query& query) {
    constexpr double kOfReach = 1e-4;
    return kOfReach * query.touch_reach;
  }
  /// Where images of the wall lie on each other, or meet: of `feet` those of all images together stay, once.
  /// A foot on an edge of one is none if another image goes on there and has its foot elsewhere, nearer; so
  /// the nearest of all is one.  `goes_on(foot, at)`: whether that image does.
  template <class Foot, class GoesOn>
  void keep_feet_of_all_images(const Query& query, std::vector<Foot>& feet, GoesOn goes_on) const {
    if (feet.size() < 2) return;
    const Candidate& candidate = candidates_.candidates()[query.candidate];
    const ImageElements* const images = candidates_.image_elements(candidate);
    const double same2 = same_place(query) * same_place(query);
    double nearest = query.list_reach;
    for (const Foot& foot : feet) nearest = std::min(nearest, foot.distance);
    auto end = feet.begin();
    for (auto foot = feet.begin(); foot != feet.end(); ++foot) {
      const auto is_there = [&](const Foot& other) {
        return other.image != foot->image && (other.point - foot->point).squaredNorm() <= same2;
      };
      const auto leads_away = [&](const ImageElements& at) {
        const nurbs::Vector3& image = candidates_.images()[at.image];
        const auto is_its_foot = [&](const Foot& other) { return other.image == image && is_there(other); };
        return image != foot->image && std::none_of(foot + 1, feet.end(), is_its_foot) && goes_on(*foot, at);
      };
      if (std::any_of(feet.begin(), end, is_there)) continue;
      if (foot->status == search::FootStatus::interior || foot->distance == nearest ||
          std::none_of(images, images + candidate.image_count, leads_away))
        *end++ = *foot;
    }
    feet.erase(end, feet.end());
  }

  static double nearest_distance(const FeetRange& feet, const Query& query) {
    double nearest = query.list_reach;
    for (const TrackedFoot& f : feet) nearest = std::min(nearest, f.foot.distance);
    return nearest;
  }
  /// No point of the surface is nearer than `clearance` now.
  void keep_clearance(const Query& query, double clearance) {
    Quiet& quiet = quiet_[query.candidate];
    const bool touches = clearance <= query.touch_reach;
    quiet.clearance = touches ? 0.0 : clearance;  // contacts are looked at until they have ended
    if (touches) return;
    quiet.centre = query.centre;
    quiet.surface_motion = surface_motion_;
  }

  /// Goes on with what candidate `before` of the last list knew, of pieces within `known` of `centre`
  /// [length].
  void go_on_quietly(int candidate, int before, const nurbs::Vector3& centre, double known) {
    Quiet quiet = quiet_before_[before];
    quiet.clearance = std::min(quiet.clearance, known - (quiet.centre - centre).norm());
    if (quiet.clearance > 0.0) quiet_[candidate] = quiet;
  }

  const CandidateList& candidates_;

 private:
  struct alignas(64) Quiet {                         // one line
    nurbs::Vector3 centre = nurbs::Vector3::Zero();  // at the last search
    double clearance = 0.0;  // no point of the surface was nearer then; 0: one touched
    double surface_motion = 0.0;
  };
  std::vector<Quiet> quiet_, quiet_before_;  // per candidate, of this list and of the last
  double surface_motion_ = 0.0;
};

}  // namespace contact
