// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/face_follower.h"

#include "brep/face_shape.h"

#include <algorithm>

namespace contact {

using nurbs::Vector3;
using search::Foot;

void FaceFollower::list_is_new() {
  FaceTracker::list_is_new();
  branches_.assign(candidates_.candidates().size(), Branches());
  followed_.clear();
}

void FaceFollower::follow(Query* queries, int count) {
  ways_.clear();
  for (const Query* query = queries; query < queries + count; ++query) {
    const Branches& branches = branches_[query->candidate];
    for (int k = 0; k < branches.count; ++k)
      ways_.push_back({&followed_[branches.first + k], &query->centre});
  }
  advance();
  for (const Query* query = queries; query < queries + count; ++query)
    if (Branches& branches = branches_[query->candidate]; branches.followed) settle(*query, branches);
  FaceTracker::follow(queries, count);
}

// Those of one patch together.
void FaceFollower::advance() {
  for (auto begin = ways_.begin(); begin != ways_.end();) {
    const int face = begin->tracked->face;
    const auto end =
        std::partition(begin, ways_.end(), [&](const Way& way) { return way.tracked->face == face; });
    feet_.clear(), centres_.clear();
    for (; begin != end; ++begin) feet_.push_back(&begin->tracked->foot), centres_.push_back(*begin->centre);
    const brep::Surface& surface = search().surface();
    surface.patches->projector(surface.faces[face].patch)
        .warm_batch(centres_.data(), feet_.data(), static_cast<int>(feet_.size()));
    for (const Foot* foot : feet_) counts().add(*foot);
  }
}

// A centre that is not fast passes a surface only through places near it.  Then sheets have their say.
bool FaceFollower::keeps_side(const Query& query, const TrackedFoot& tracked) const {
  const Foot& foot = tracked.foot;
  if (foot.distance >= kDeepInReach * query.touch_reach) return true;
  const Vector3 normal = brep::normal_on(search().surface(), tracked.face, foot.xi);
  return tracked.side * normal.dot(query.centre - foot.point) > 0.0;
}

// What was not to be expected is left to the search for all.
void FaceFollower::settle(const Query& query, Branches& branches) {
  TrackedFoot* const first = followed_.data() + branches.first;
  const auto is_sound = [&](const TrackedFoot& tracked) {
    return tracked.foot.status == search::FootStatus::interior && keeps_side(query, tracked);
  };
  if (!query.is_fast() && std::all_of(first, first + branches.count, is_sound)) return;
  branches.followed = false;
  branches.count = 0;
}

FeetRange FaceFollower::feet(const Query& query, const ParticleSlots& slots) {
  Branches& branches = branches_[query.candidate];
  if (branches.is_new) {
    branches.is_new = false;
    branches.followed = may_be_followed(query);
    if (branches.followed) begin(query, slots, branches);
  }
  if (!branches.followed) return FaceTracker::feet(query, slots);
  const FeetRange feet{followed_.data() + branches.first, branches.count};
  keep_clearance(query, nearest_distance(feet, query));
  return feet;
}

// All that it may come to before the next list, with the slots of those that are known.
void FaceFollower::begin(const Query& query, const ParticleSlots& slots, Branches& branches) {
  Query wide = query;
  wide.touch_reach = query.list_reach;
  const FeetRange all = FaceTracker::feet(wide, slots);
  forget(query);
  branches.first = static_cast<int>(followed_.size());
  branches.count = all.count;
  followed_.insert(followed_.end(), all.begin(), all.end());
  const auto is_inside = [](const TrackedFoot& tracked) {
    return tracked.foot.status == search::FootStatus::interior && tracked.foot.distance >= 0.0;
  };
  if (std::all_of(all.begin(), all.end(), is_inside)) return;
  followed_.resize(branches.first);
  branches.followed = false;
  branches.count = 0;
}

bool FaceFollower::may_be_followed(const Query& query) {
  if (query.is_fast()) return false;
  const brep::Surface& surface = search().surface();
  const Candidate& candidate = candidates_.candidates()[query.candidate];
  const ImageElements* images = candidates_.image_elements(candidate);
  const auto is_element = [&](int piece) { return surface.pieces[piece].kind == brep::Piece::Kind::element; };
  for (int k = 0; k < candidate.image_count; ++k) {
    const Vector3 d = query.centre - candidates_.images()[images[k].image];
    const int* const listed = candidates_.elements(images[k]);
    if (std::none_of(listed, listed + images[k].count, is_element)) return false;
    near_.resize(images[k].count);
    near_.resize(search().activate(d, query.list_reach, candidates_.elements(images[k]), images[k].count,
                                   near_.data()));
    const auto has_one_foot = [&](int number) {
      const brep::Piece& piece = surface.pieces[number];
      return piece.kind == brep::Piece::Kind::element &&
             surface.patches->has_one_foot(surface.faces[piece.face].patch, piece.element(), d,
                                           query.list_reach);
    };
    if (!std::all_of(near_.begin(), near_.end(), has_one_foot)) return false;
  }
  return true;
}

}  // namespace contact
