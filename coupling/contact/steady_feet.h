// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts inside faces that stay there: what most contacts do in most steps.  Who has looked at all pieces
// near a candidate says how far it may move until it can have other feet than these (keep); until then its
// heights over their faces are all that is asked for: no search, no matching of slots, no question to anybody
// else.  Feet over planes and on one cylinder are found a block at a time (feet_kernel.h); their digits are
// those of a search.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "brep/foot_search.h"
#include "coupling/contact/contact_memory.h"
#include "coupling/contact/face_kernel.h"
#include "coupling/contact/face_names.h"
#include "coupling/contact/feet_kernel.h"
#include "coupling/rigid_frame.h"
#include "nurbs/assert.h"
#include "nurbs/processor.h"

namespace contact {

class SteadyFeet {
 public:
  static constexpr int kBlock = FeetBlock::kCapacity;
  static constexpr int kMostFeet = 4;  ///< of one candidate

  /// Keeps references.
  SteadyFeet(const brep::FootSearch& search, const FaceNames& names);

  /// For a new list; those of the last are at hand to go_on() with.
  void forget_all(std::size_t candidates) {
    rests_.swap(rests_before_), further_.swap(further_before_);
    rests_.assign(candidates, Rest());
    further_.clear();
    if (search_.surface().patches) followed_.resize(candidates);
  }
  /// With the feet of candidate `before` of the last list, of which all is known that is within `known` of
  /// `centre` [length]; they are on faces in closed form.
  void go_on(int candidate, int before, const nurbs::Vector3& centre, double known);
  void forget(int candidate) { rests_[candidate].piece = kNone; }

  /// Where a candidate was, and how far it may go: it has the feet that it is kept with, as long as it
  /// reaches `margin` less than `reach` and has not moved by more than `margin` [length].
  struct Room {
    const nurbs::Vector3& centre;
    double reach, margin;
  };
  /// One foot, over this piece.
  void keep(int candidate, const Room& room, int piece, const brep::Foot& foot, const nurbs::Vector3& centre);
  /// Up to kMostFeet feet over plane faces, the nearest first; pieces[k] is below foot k.
  void keep(int candidate, const Room& room, const std::vector<brep::Foot>& feet, const int* pieces);

  /// Begins a block, of centres in space that `frame` has in the wall's.
  void begin_block(const coupling::RigidFrame& frame, bool is_turned) {
    block_.count = curved_count_ = group_count_ = 0;
    frame_ = &frame;
    is_turned_ = is_turned;
  }
  /// Adds a candidate, if it has such feet; how many lines of the block they take, whose numbers rise, 0:
  /// none. There must be room for kMostFeet.  `x`, `v`: of its centre.
  int add(int candidate, int particle, const double* x, const double* v, double touch_reach) {
    NURBS_ASSERT(candidate < static_cast<int>(rests_.size()), candidate, rests_.size());
    const Rest& rest = rests_[candidate];
    if (rest.piece < 0) return 0;
    add_line(candidate, particle, x, v, touch_reach, rest);
    return rest.feet == 1 ? 1 : add_group(particle, x, v, touch_reach, rest);
  }

  /// Candidates of this block with several feet: lines [first, first + count).
  struct Group {
    int first, count;
  };
  const Group* begin() const { return groups_; }
  const Group* end() const { return groups_ + group_count_; }

  /// Finds the feet of those that were added, lines 0 to count() - 1.  Of a group all are there, or none.
  void find(const StepNumbers& step);
  int count() const { return block_.count; }
  int candidate(int k) const { return candidate_[k]; }
  int particle(int k) const { return particle_[k]; }
  /// Whether the candidate still has those feet alone, and the step leaves them as they are (StepNumbers).
  bool is_there(int k) const { return block_.room[k] > 0.0; }
  void drop(const Group& group) {
    for (int k = group.first; k < group.first + group.count; ++k) block_.room[k] = 0.0;
  }
  nurbs::SurfacePoint at(int k) const {
    return {names_.patch_of(face_[k]), {block_.xi[0][k], block_.xi[1][k]}};
  }
  /// Whether a slot has been on the foot's face, on a side that is known.
  bool has_been_on_face(const ContactSlot& slot, int k) const {
    return slot.is_beside(names_.patch_of(face_[k])) &&
           (!names_.parts || names_.parts->part_at(slot.foot()) == face_[k]);
  }
  /// From the foot to the centre, in space [length].
  nurbs::Vector3 delta(int k) const { return {block_.delta[0][k], block_.delta[1][k], block_.delta[2][k]}; }
  double distance(int k) const { return block_.distance[k]; }
  int side(int k) const { return marks_[k].side; }  ///< of the patch, where the centre is: +1 or -1
  /// The slot of the particle's memory that has the foot's branch; -1: settle() was not told yet.
  int slot(int k) const { return marks_[k].slot; }
  /// Whoever fills or clears that slot otherwise asks for feet anew.
  void settle(int k, int slot) {
    marks_[k].slot = static_cast<std::int8_t>(slot);
    rest_of(k).marks.slot = marks_[k].slot;
  }

 private:
  static constexpr int kNone = -1;
  struct Marks {       // copied as one number
    std::int8_t side;  // of the patch
    std::int8_t slot;
    std::int8_t number;  // among the feet of its candidate
    bool is_curved;
  };
  struct alignas(64) Rest {
    nurbs::Vector3 centre;
    double reach, margin;
    float sign;  // of its height over the face
    std::int32_t piece = kNone, face;
    alignas(4) Marks marks;
    std::int32_t feet;             // of the candidate; the others are at
    std::int32_t further = kNone;  // in further_, if it ever had several
  };
  static_assert(sizeof(Rest) == 64, "one cache line");

  void add_line(int candidate, int particle, const double* x, const double* v, double touch_reach,
                const Rest& rest) {
    const int k = block_.count++;
    candidate_[k] = candidate, particle_[k] = particle, piece_[k] = rest.piece;
    face_[k] = rest.face, marks_[k] = rest.marks;
    block_.sign[k] = static_cast<double>(rest.sign);
    block_.touch_reach[k] = touch_reach;
    block_.margin[k] = std::min(rest.reach - touch_reach, rest.margin);  // it may have grown or shrunk
    for (int d = 0; d < 3; ++d) block_.centre[d][k] = x[d], block_.before[d][k] = rest.centre[d];
    block_.squared_speed[k] = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if (rest.marks.is_curved) curved_[curved_count_++] = k;
    if (waits_for_memory_) nurbs::prefetch(search_.triangle(rest.piece));  // find() looks at it
  }
  int add_group(int particle, const double* x, const double* v, double touch_reach, const Rest& rest);
  Rest& rest_of(int k) {
    Rest& first = rests_[candidate_[k]];
    return marks_[k].number == 0 ? first : further_[first.further + marks_[k].number - 1];
  }
  static void set(Rest& rest, const Room& room, int piece, int face, int side);
  std::int8_t of_patch(int face, int side) const { return static_cast<std::int8_t>(names_.side(face, side)); }
  bool is_one_face() const;
  void find_in_frame();
  void find_on_planes();
  void find_on_faces();
  bool find_on_one_cylinder();
  void find_on_chart(int k);
  void find_on_patch(int k);
  void bring_together(const Group& group);

  const brep::FootSearch& search_;
  FaceNames names_;
  const std::vector<brep::Chart>* charts_;  // of these
  bool waits_for_memory_;
  std::vector<Rest> rests_;    // per candidate
  std::vector<Rest> further_;  // kMostFeet - 1 for each that has had several feet
  struct Followed {
    nurbs::Parameter<2> xi;
    nurbs::Vector3 up;  // from the foot to the centre
  };
  std::vector<Followed> followed_;                   // per candidate, of feet on patches
  std::vector<Rest> rests_before_, further_before_;  // of the last list

  FeetKernel kernel_;
  const coupling::RigidFrame* frame_ = nullptr;
  bool is_turned_ = false;
  int curved_count_ = 0, group_count_ = 0;
  int candidate_[kBlock] = {}, particle_[kBlock] = {}, piece_[kBlock] = {}, face_[kBlock] = {},
      curved_[kBlock] = {};
  alignas(4) Marks marks_[kBlock] = {};
  Group groups_[kBlock / 2] = {};
  FeetBlock block_;
  FaceKernel face_kernel_;
  std::vector<FaceNumbers> faces_;  // of walls whose faces have no charts
  FaceBlock on_faces_;
  double inside_[2][kBlock] = {};  // of charts of cylinders
};

}  // namespace contact
