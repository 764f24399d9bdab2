// SPDX-License-Identifier: GPL-2.0-or-later
// The feet of candidates on a wall whose faces are patches, at least in part.
//
// A foot on a patch takes an iteration.  Where nothing but elements of patches is near, no edge and no
// vertex, and a second foot is excluded on each (search/second_foot.h), none can appear or vanish until the
// next rebuild: feet found when the list is new are followed from their last place, many together, as on
// smooth walls (contact_tracker.h).  All others are found as face_tracker.h does.
#pragma once

#include <vector>

#include "coupling/contact/face_tracker.h"

namespace contact {

class FaceFollower final : public FaceTracker {
 public:
  /// Keeps references to all.  Feet are given in the faces' own parameters: `names` has no charts.
  FaceFollower(const brep::FootSearch& search, const FaceNames& names, const CandidateList& candidates,
               SearchCounts& counts)
      : FaceTracker(search, names, candidates, counts) {}

  void list_is_new() override;
  void follow(Query* queries, int count) override;
  FeetRange feet(const Query& query, const ParticleSlots& slots) override;

 private:
  struct Branches {
    int first = 0, count = 0;  // range in followed_
    bool is_new = true, followed = false;
  };
  struct Way {
    TrackedFoot* tracked;
    const nurbs::Vector3* centre;
  };
  bool may_be_followed(const Query& query);
  void begin(const Query& query, const ParticleSlots& slots, Branches& branches);
  void advance();
  void settle(const Query& query, Branches& branches);
  bool keeps_side(const Query& query, const TrackedFoot& tracked) const;

  std::vector<Branches> branches_;     // per candidate
  std::vector<TrackedFoot> followed_;  // of those that are followed
  std::vector<Way> ways_;              // of one block of candidates; so are the next three
  std::vector<search::Foot*> feet_;
  std::vector<nurbs::Vector3> centres_;
  std::vector<int> near_;  // of one candidate
};

}  // namespace contact
