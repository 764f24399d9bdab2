// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/face_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "brep/face_shape.h"
#include "nurbs/assert.h"

namespace contact {

using nurbs::Vector3;

namespace {

// How far a particle moves before it chooses pieces again: over one face, of what its list has to spare, so
// that they last as long as the list does, or of its reach; over several, of its reach.  From where on it
// chooses none.
constexpr double kOfList = 0.5, kMargin = 0.2, kSmallMargin = 0.05, kNear = 1.05;
constexpr int kCalm = 8;  // looks at the same pieces, after which it may do with fewer
constexpr double kNoWay = std::numeric_limits<double>::infinity();

// What just touches does.
double beyond(const FeetTracker::Query& query) {
  constexpr double kRoundOff = std::numeric_limits<double>::epsilon();
  return query.touch_reach * (1.0 + kRoundOff);
}

}  // namespace

inline bool FaceTracker::has_moved_less(const Query& query, const State& state, double than) {
  return (query.centre - state.centre).squaredNorm() <= than * than;
}

void FaceTracker::follow(Query* queries, int count) {
  if (!search_.outgrows_cache()) return;
  for (const Query* query = queries; query < queries + count; ++query) prefetch(*query);
}

// What it looks at first is on its way while others are looked at: memory takes longer than all the rest.
void FaceTracker::prefetch(const Query& query) const {
  if (states_[query.candidate].reach > 0.0)
    for_each_image(query, Of::chosen, [&](const Vector3&, const int* pieces, int number, const Vector3&) {
      search_.prefetch(pieces, number);
    });
}

FeetRange FaceTracker::feet(const Query& query, const ParticleSlots& slots) {
  State& state = states_[query.candidate];
  if (query.is_fast()) return feet_of_fast(query, slots);
  const double margin = state.reach - query.touch_reach;
  const bool is_near = margin >= 0.0 && has_moved_less(query, state, margin);
  double distance = 0.0;  // at least, of the nearest piece; a foot takes longer
  if (!is_near) {
    if (slots.used() == 0) distance = nearest(query, query.list_reach, Of::list);  // else it has touched
    if (distance > kNear * query.touch_reach) return none(query, slots, distance);
    choose_pieces(query);
  } else {
    if (slots.used() == 0) distance = nearest_of_chosen(query);
    if (++state.looks == kCalm) choose_fewer_pieces(query);
  }
  if (distance >= beyond(query)) return none(query, slots, distance);
  find(query, beyond(query), margin_to_rest(query));
  match_slots(query, slots);
  if (found_.empty()) return none(query, slots, nearest_of_chosen(query));
  keep_clearance(query, 0.0);
  return {feet_.data(), static_cast<int>(feet_.size())};
}

// It may be across in the next step without having touched.
FeetRange FaceTracker::feet_of_fast(const Query& query, const ParticleSlots& slots) {
  choose_pieces(query, Of::list, query.list_reach - query.touch_reach);
  find(query, query.list_reach);
  match_slots(query, slots);
  if (found_.empty()) return none(query, slots, query.list_reach);
  keep_clearance(query, found_[0].distance);
  return {feet_.data(), static_cast<int>(feet_.size())};
}

// Of a particle that is slow, so that the few are enough for a while.
void FaceTracker::choose_fewer_pieces(const Query& query) {
  constexpr double kWhile = 16.0, kLeast = 0.01;  // of what it has moved since; of its reach
  const State& state = states_[query.candidate];
  const double moved = (query.centre - state.centre).norm();
  const double margin = std::max(kWhile * moved, kLeast * query.touch_reach);
  if (margin + moved < 0.5 * (state.reach - query.touch_reach)) choose_pieces(query, Of::chosen, margin);
}

FeetRange FaceTracker::none(const Query& query, const ParticleSlots& slots, double clearance) {
  keep_clearance(query, clearance);
  states_[query.candidate].sheet = -1;
  steady_.forget(query.candidate);
  slots.clear();
  return {feet_.data(), 0};
}

double FaceTracker::nearest(const Query& query, double reach, Of of) const {
  for_each_image(query, of, [&](const Vector3& d, const int* pieces, int count, const Vector3&) {
    reach = search_.nearest(d, reach, pieces, count);
  });
  return reach;
}

// As far as those chosen tell.
double FaceTracker::nearest_of_chosen(const Query& query) const {
  const State& state = states_[query.candidate];
  return nearest(query, state.reach - (query.centre - state.centre).norm(), Of::chosen);
}

// What is not over one face alone comes back soon, and does not try again.
void FaceTracker::choose_pieces(const Query& query) {
  const State& state = states_[query.candidate];
  const bool list_is_new = state.reach == 0.0;
  const double margin = kMargin * query.touch_reach,
               widest = list_is_new ? kOfList * (query.list_reach - query.touch_reach) : 0.0;
  choose_pieces(query, Of::list, std::max(margin, widest));
  if (state.alone < 0 && widest > margin) choose_pieces(query, Of::chosen, margin);
  if (state.alone < 0) choose_pieces(query, Of::chosen, kSmallMargin * query.touch_reach);
}

void FaceTracker::choose_pieces(const Query& query, Of of, double margin) {
  State& state = states_[query.candidate];
  state.centre = query.centre;
  state.reach = query.touch_reach + margin;
  state.looks = state.next_try = 0;
  const Candidate& candidate = candidates_.candidates()[query.candidate];
  const ImageElements* image = candidates_.image_elements(candidate);
  int* count = &piece_counts_[candidate.first_image];
  for_each_image(query, of, [&](const Vector3& d, const int* pieces, int number, const Vector3&) {
    *count++ =
        search_.activate_with_feet(d, state.reach, margin, pieces, number, pieces_.data() + (image++)->first);
  });
  state.margin = margin;
  state.alone = -1;
  if (candidate.image_count > 1) leave_out_images_in_its_face(query);
  const PiecesHere pieces = pieces_of_wall_itself(query);
  if (pieces.count > 0 &&
      search_.is_well_inside(pieces.first, pieces.count, query.centre, state.reach, margin))
    state.alone = *pieces.first;
}

// Feet within `reach`; with a margin also those that others come to while the centre moves by less (near_),
// and how far it may move until they are not all (room_).
void FaceTracker::find(const Query& query, double reach, double margin) {
  found_.clear(), near_.clear();
  room_ = 0.0;
  if (margin > 0.0) {
    const PiecesHere pieces = pieces_of_wall_itself(query);
    room_ = search_.feet_for_a_while(query.centre, reach, margin, pieces.first, pieces.count, found_);
    const auto far = std::find_if(found_.begin(), found_.end(),
                                  [&](const brep::Foot& foot) { return foot.distance >= reach; });
    near_.assign(far, found_.end());
    found_.erase(far, found_.end());
  } else {
    for_each_image(query, Of::chosen,
                   [&](const Vector3& d, const int* pieces, int count, const Vector3& image) {
                     const std::size_t first = found_.size();
                     search_.feet(d, reach, pieces, count, found_);
                     brep::Foot* const end = found_.data() + found_.size();
                     for (brep::Foot* foot = found_.data() + first; foot != end; ++foot) {
                       foot->image = image;
                       foot->point += image;
                     }
                   });
  }
  if (found_.size() > 1) {
    const std::size_t all = found_.size();
    std::sort(found_.begin(), found_.end(),
              [](const brep::Foot& a, const brep::Foot& b) { return a.distance < b.distance; });
    if (candidates_.candidates()[query.candidate].image_count > 1) keep_feet_of_all_images(query);
    if (found_.size() < all) room_ = 0.0;
  }
  for (const brep::Foot& foot : found_) counts_.add_direct(foot);
}

// Whether the centre is, or may be, inside a body whose skin it pressed on: the plane at where the foot was
// last is not the surface.
bool FaceTracker::may_be_behind(const Query& query, const ParticleSlots& slots) const {
  for (int s = 0; s < slots.used(); ++s) {
    if (slots.slot(s).empty()) continue;
    const nurbs::SurfacePoint last = slots.slot(s).foot();
    const int face = names_.face_at(last), outward = search_.surface().faces[face].outward;
    if (outward == 0) continue;
    const Vector3 point = brep::point_on(search_.surface(), face, last.xi),
                  out = outward * brep::normal_on(search_.surface(), face, last.xi);
    bool is_deep = false;
    double nearest = kNoWay;
    for (const Vector3& image : candidates_.images()) {
      const Vector3 from = query.centre - image - point;
      if (from.squaredNorm() >= nearest) continue;
      nearest = from.squaredNorm();
      is_deep = out.dot(from) < kDeepInReach * query.touch_reach;
    }
    if (is_deep) return true;
  }
  return false;
}

void FaceTracker::add_feet_behind(const Query& query, const ParticleSlots& slots) {
  if (!search_.has_inside() || !may_be_behind(query, slots)) return;
  const auto in_front = static_cast<std::ptrdiff_t>(found_.size());
  for_each_image(query, Of::list, [&](const Vector3& d, const int* pieces, int count, const Vector3& image) {
    const std::size_t first = found_.size();
    search_.feet_behind(d, query.touch_reach, pieces, count, found_);
    for (std::size_t k = first; k < found_.size(); ++k) found_[k].image = image, found_[k].point += image;
  });
  std::rotate(found_.begin(), found_.begin() + in_front, found_.end());  // the least distances first
}

// Feet behind skins that no branch has passed; and feet that lie behind a skin that one has: particles do not
// meet the far side of thin sheet through it.
void FaceTracker::drop_feet_through_bodies(const Query& query) {
  const auto is_through = [&](const brep::Foot& foot) {
    for (const TrackedFoot& deep : feet_) {
      if (deep.slot < 0 || deep.foot.distance >= 0.0) continue;
      const Vector3 inward = query.centre - deep.foot.point;
      if (inward.dot(query.centre - foot.point) > 0.0 && inward.dot(foot.point - deep.foot.point) > 0.0)
        return true;
    }
    return false;
  };
  std::size_t kept = 0;
  for (std::size_t k = 0; k < found_.size(); ++k) {
    if (feet_[k].slot < 0 && (found_[k].distance < 0.0 || is_through(found_[k]))) continue;
    std::swap(found_[kept], found_[k]);
    std::swap(feet_[kept++], feet_[k]);
  }
  found_.erase(found_.begin() + static_cast<std::ptrdiff_t>(kept), found_.end());
  feet_.erase(feet_.begin() + static_cast<std::ptrdiff_t>(kept), feet_.end());
}

// Squared distance of a foot from where a branch was last, on the image that was the nearest to it.
double FaceTracker::squared_way(const Query& query, const Vector3& last, const Vector3& now) const {
  double least = kNoWay;
  const auto look_at = [&](const Vector3& image) {
    least = std::min(least, (last + image - now).squaredNorm());
  };
  for_each_image(query, Of::chosen,
                 [&](const Vector3&, const int*, int, const Vector3& image) { look_at(image); });
  if (least > query.touch_reach * query.touch_reach)  // one that is left out, as others repeat it
    for (const Vector3& image : candidates_.images()) look_at(image);
  return least;
}

// Squared way of a slot's branch from where it was last to a foot; infinite if that cannot be the same.
double FaceTracker::squared_way(const Query& query, const ContactSlot& slot, const brep::Foot& foot) const {
  const nurbs::SurfacePoint last = slot.foot();
  const brep::Surface& surface = search_.surface();
  const int face = names_.face_at(last);
  if (surface.sheet(face, names_.side(face, slot.side())) != foot.sheet) return kNoWay;
  const brep::Parameter<2> xi = names_.charts ? (*names_.charts)[face].to_face(last.xi) : last.xi;
  const double way2 = squared_way(query, brep::point_on(surface, face, xi), foot.point);
  // On one face a particle may have been displaced, however far.
  return face == foot.patch || way2 <= query.touch_reach * query.touch_reach ? way2 : kNoWay;
}

TrackedFoot FaceTracker::tracked(const brep::Foot& foot) const {
  const search::Foot& on_surface = foot;
  TrackedFoot tracked{on_surface, -1, names_.side(foot.patch, foot.side), foot.patch};
  tracked.foot.patch = names_.patch_of(foot.patch);
  tracked.foot.xi = names_.on_patch(foot.patch, foot.xi);
  return tracked;
}

void FaceTracker::match_slots(const Query& query, const ParticleSlots& slots) {
  add_feet_behind(query, slots);
  feet_.clear();
  for (const brep::Foot& foot : found_) feet_.push_back(tracked(foot));
  if (is_last_foot(query, slots))
    feet_[0].slot = 0;
  else if (slots.used() > 0)
    match_nearest(query, slots);
  const auto is_behind = [](const brep::Foot& foot) { return foot.distance < 0.0; };
  if (std::any_of(found_.begin(), found_.end(), is_behind)) drop_feet_through_bodies(query);
  State& state = states_[query.candidate];
  state.sheet = found_.size() == 1 ? found_[0].sheet : -1;
  if (found_.empty()) return;
  const brep::Foot& foot = found_[0];
  state.last = foot.point;
  if (state.sheet >= 0 && state.alone >= 0 && foot.distance >= 0.0)
    steady_.keep(query.candidate, {state.centre, state.reach, state.margin}, state.alone, foot, query.centre);
  else if (!may_rest(query))
    steady_.forget(query.candidate);
}

// Feet inside plane faces and on edges stay what they are while the centre does not come to where others
// begin or end.  That is worth finding out if it lasts for some steps (lasts); where it does not, it is left
// for a while.
bool FaceTracker::lasts(const Query& query, double room) {
  constexpr double kSteps = 4.0;
  return room > 0.0 && room * room > kSteps * kSteps * query.squared_travel;
}

// How far the centre may move while those chosen are enough; 0: it is not time to ask.
double FaceTracker::margin_to_rest(const Query& query) const {
  const State& state = states_[query.candidate];
  if (state.alone >= 0 || state.looks < state.next_try || pieces_of_wall_itself(query).count == 0) return 0.0;
  const double margin = state.reach - (query.centre - state.centre).norm() - query.touch_reach;
  return lasts(query, margin) ? margin : 0.0;
}

bool FaceTracker::may_rest(const Query& query) {
  constexpr int kWhile = 8;
  State& state = states_[query.candidate];
  if (state.looks < state.next_try) return false;
  state.next_try = state.looks + kWhile;
  if (!lasts(query, room_) || found_.size() > SteadyFeet::kMostFeet) return false;
  const PiecesHere pieces = pieces_of_wall_itself(query);
  int below[SteadyFeet::kMostFeet];
  const int touching = static_cast<int>(found_.size());
  for (const brep::Foot& foot : near_) {
    if (found_.size() < SteadyFeet::kMostFeet)
      found_.push_back(foot);
    else
      room_ = std::min(room_, foot.distance - query.touch_reach);
  }
  const double room =
      search_.room_of_feet(query.centre, query.touch_reach, room_, pieces.first, pieces.count, found_, below);
  const bool lasting = lasts(query, room);
  if (lasting)
    steady_.keep(query.candidate, {query.centre, query.touch_reach + room, room}, found_, touching, below);
  found_.resize(touching);
  if (!lasting) return false;
  state.next_try = 0;
  return true;
}

// Most have one contact, and had it before: then nobody asks the slot where that was.
bool FaceTracker::is_last_foot(const Query& query, const ParticleSlots& slots) const {
  const State& state = states_[query.candidate];
  return found_.size() == 1 && slots.used() == 1 && found_[0].sheet == state.sheet &&
         (found_[0].point - state.last).squaredNorm() <= query.touch_reach * query.touch_reach;
}

// A slot goes to the foot of its sheet that is nearest to where its branch was last, the nearest pair first.
void FaceTracker::match_nearest(const Query& query, const ParticleSlots& slots) {
  pairs_.clear();
  for (int s = 0; s < slots.used(); ++s) {
    if (slots.slot(s).empty()) continue;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      const double way2 = squared_way(query, slots.slot(s), found_[k]);
      if (way2 < kNoWay) pairs_.push_back({way2, s, static_cast<int>(k)});
    }
  }
  if (pairs_.size() > 1)
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) { return a.way2 < b.way2; });
  const auto is_matched = [&](int slot) {
    return std::any_of(feet_.begin(), feet_.end(), [&](const TrackedFoot& f) { return f.slot == slot; });
  };
  for (const Pair& pair : pairs_)
    if (feet_[pair.foot].slot < 0 && !is_matched(pair.slot)) feet_[pair.foot].slot = pair.slot;
  for (int s = 0; s < slots.used(); ++s)
    if (!is_matched(s)) slots.slot(s).clear();
  slots.trim_used();
}

}  // namespace contact
