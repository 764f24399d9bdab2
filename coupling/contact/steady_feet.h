// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts that are inside one face, and stay there: what most contacts do in most steps.  Who has looked at
// all pieces near a candidate says how far it may move until the others matter (keep); until then its height
// over that face is its only foot, and needs no search, no matching of slots, no question to anybody else.
// Feet over planes and on one cylinder are found a block at a time (feet_kernel.h); their digits are those of
// a search.
#pragma once

#include <cstdint>
#include <vector>

#include "brep/foot_search.h"
#include "coupling/contact/feet_kernel.h"
#include "coupling/rigid_frame.h"
#include "nurbs/assert.h"
#include "nurbs/processor.h"

namespace contact {

/// Of a centre over one face; its branch has slot 0.
struct SteadyFoot {
  int candidate, particle;  ///< numbers in their lists
  nurbs::SurfacePoint at;
  nurbs::Vector3 delta;  ///< from the foot to the centre, in space [length]
  double distance;       ///< [length]
  int side;              ///< of the patch, where the centre is: +1 or -1
  bool is_settled;       ///< settle() was told so

  /// As a search would have it; it is at `point` in the wall's frame.
  search::Foot searched(const nurbs::Vector3& point) const {
    return {at.xi, point, distance, search::FootStatus::interior, 0, at.patch};
  }
};

class SteadyFeet {
 public:
  static constexpr int kBlock = FeetBlock::kCapacity;

  /// Keeps references.  `charts`: to the parameters that feet are given in; null: the faces' own.
  SteadyFeet(const brep::FootSearch& search, const std::vector<brep::Chart>* charts)
      : search_(search),
        charts_(charts),
        waits_for_memory_(search.outgrows_cache()),
        kernel_(feet_kernel(nurbs::simd_level())) {}

  void forget_all(std::size_t candidates) {
    rests_.assign(candidates, Rest());
    if (search_.surface().patches) followed_.resize(candidates);
  }
  void forget(int candidate) { rests_[candidate].piece = kNone; }
  /// A candidate that was at `centre` has one foot, over this piece, on this side of its face, as long as it
  /// reaches `margin` less than `reach` and has not moved by more than `margin` [length].  `xi`: where it is
  /// followed (brep::FootSearch).
  void keep(int candidate, int piece, int face, int side, const nurbs::Vector3& centre, double reach,
            double margin, const nurbs::Parameter<2>& xi);
  /// Its slot is filled with that foot's branch.  Whoever fills or clears it otherwise asks for feet anew.
  void settle(int candidate) { rests_[candidate].marks.is_settled = true; }

  /// Begins a block, of centres in space that `frame` has in the wall's.
  void begin_block(const coupling::RigidFrame& frame, bool is_turned) {
    block_.count = curved_count_ = 0;
    frame_ = &frame;
    is_turned_ = is_turned;
  }
  /// Adds a candidate, of kBlock at most, if it has such a foot; else false.  `x`: its centre.
  bool add(int candidate, int particle, const double* x, double touch_reach) {
    NURBS_ASSERT(candidate < static_cast<int>(rests_.size()), candidate, rests_.size());
    const Rest& rest = rests_[candidate];
    if (rest.piece < 0) return false;
    const int k = block_.count++;
    candidate_[k] = candidate, particle_[k] = particle, piece_[k] = rest.piece;
    face_[k] = rest.face, marks_[k] = rest.marks;
    block_.sign[k] = rest.sign;
    block_.touch_reach[k] = touch_reach, block_.reach[k] = rest.reach, block_.margin[k] = rest.margin;
    for (int d = 0; d < 3; ++d) block_.centre[d][k] = x[d], block_.before[d][k] = rest.centre[d];
    if (rest.marks.is_curved) curved_[curved_count_++] = k;
    if (waits_for_memory_) nurbs::prefetch(search_.triangle(rest.piece));  // find() looks at it
    return true;
  }
  /// Finds the feet of those that were added, numbers 0 to count() - 1.
  void find();
  int count() const { return block_.count; }
  int candidate(int k) const { return candidate_[k]; }
  /// Whether it still has that foot alone, nearer than it touches.
  bool is_there(int k) const { return block_.room[k] > 0.0; }
  SteadyFoot foot(int k) const {
    return {candidate_[k],
            particle_[k],
            {face_[k], {block_.xi[0][k], block_.xi[1][k]}},
            {block_.delta[0][k], block_.delta[1][k], block_.delta[2][k]},
            block_.distance[k],
            marks_[k].side,
            marks_[k].is_settled};
  }

 private:
  static constexpr int kNone = -1;
  struct alignas(4) Marks {  // copied as one number
    std::int8_t side;        // of the patch
    bool is_curved, is_settled;
    bool unused = false;
  };
  struct alignas(64) Rest {
    nurbs::Vector3 centre;
    double reach, margin;
    double sign;  // of its height over the face
    std::int32_t piece = kNone, face;
    Marks marks;
  };
  bool is_one_face() const;
  void find_in_frame();
  void find_on_planes();
  bool find_on_one_cylinder();
  void find_on_curved(int k);

  const brep::FootSearch& search_;
  const std::vector<brep::Chart>* charts_;
  bool waits_for_memory_;
  std::vector<Rest> rests_;                    // per candidate
  std::vector<nurbs::Parameter<2>> followed_;  // likewise, where feet are followed (brep::FootSearch)

  FeetKernel kernel_;
  const coupling::RigidFrame* frame_ = nullptr;
  bool is_turned_ = false;
  int curved_count_ = 0;
  int candidate_[kBlock] = {}, particle_[kBlock] = {}, piece_[kBlock] = {}, face_[kBlock] = {},
      curved_[kBlock] = {};
  Marks marks_[kBlock] = {};
  FeetBlock block_;
  double inside_[2][kBlock] = {};  // of charts of cylinders
};

}  // namespace contact
