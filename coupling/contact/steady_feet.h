// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts that stay inside faces or on edges: what most contacts do in most steps.  Who has looked at all
// pieces near a candidate says how far it may move until it can have other feet than these (keep); until then
// its heights over their faces and its ways from the edges are all that is asked for: no search, no matching
// of slots, no question to anybody else.  Feet over planes and on one cylinder are found a block at a time
// (feet_kernel.h), beside what they were kept with, which stands in the order of the candidates; their digits
// are those of a search.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
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
  static constexpr int kBlock = FeetBlock::kCapacity;  ///< candidates of one block
  static constexpr int kMostFeet = 4;                  ///< of one candidate

  /// Keeps references.
  SteadyFeet(const brep::FootSearch& search, const FaceNames& names);

  /// For a new list; those of the last are at hand to go_on() with.
  void forget_all(std::size_t candidates);
  /// With the feet of candidate `before` of the last list, of which all is known that is within `known` of
  /// `centre` [length]; they are on faces in closed form.
  void go_on(int candidate, int before, const nurbs::Vector3& centre, double known);
  void forget(int candidate) { page_of(candidate).forget(line_of(candidate)); }

  /// Where a candidate was, and how far it may go: it has the feet that it is kept with, as long as it
  /// reaches `margin` less than `reach` and has not moved by more than `margin` [length].
  struct Room {
    const nurbs::Vector3& centre;
    double reach, margin;
  };
  /// One foot, over this piece.
  void keep(int candidate, const Room& room, int piece, const brep::Foot& foot, const nurbs::Vector3& centre);
  /// Feet over plane faces, those that touch first, of these the nearest first; pieces[k] is below foot k, or
  /// the number of its edge if it is on one.  No more than kMostFeet, of which `touching` are contacts.
  void keep(int candidate, const Room& room, const std::vector<brep::Foot>& feet, int touching,
            const int* pieces);

  /// Begins the block of candidates from number `first` on, a multiple of kBlock, which are its lines;
  /// centres are in space that `frame` has in the wall's.  Whether any of them has such feet.
  bool begin_block(int first, int count, const coupling::RigidFrame& frame, bool is_turned);
  bool has(int k) const { return page_->piece[k] >= 0; }
  /// One that has such feet; those that are not added are not there.  `x`, `v`: of its centre.
  void add(int k, const double* x, const double* v, double touch_reach) {
    NURBS_ASSERT(has(k) && k < block_.count, k, block_.count);
    for (int d = 0; d < 3; ++d) block_.centre[d][k] = x[d];
    block_.squared_speed[k] = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    block_.touch_reach[k] = touch_reach;
  }

  /// Finds the feet of those that were added.
  void find(const StepNumbers& step);
  /// Whether the candidate still has those feet alone, and the step leaves them as they are (StepNumbers).
  bool is_there(int k) const { return block_.room[k] > 0.0; }
  int feet(int k) const { return page_->marks[k].feet; }

  enum class On : std::int8_t { plane, curved, edge };  ///< what the foot is on
  struct alignas(4) Marks {                             // copied as one number
    std::int16_t slot;      ///< of the particle's memory; -1: settle() was not told yet
    std::uint8_t feet : 4;  ///< of the candidate
    std::uint8_t kept : 4;  ///< these, and those that do not touch
    On on;
  };
  static_assert(sizeof(Marks) == 4 && kMostFeet < 16, "feet and kept have four bits each");
  /// One of them, in space; for as long as its block lasts.
  class Foot {
   public:
    Foot(const FeetBlock& block, int line, int face, int patch, const Marks& marks)
        : block_(block), line_(line), face_(face), patch_(patch), marks_(marks) {}
    int face() const { return face_; }
    int patch() const { return patch_; }
    nurbs::Parameter<2> xi() const { return {block_.xi[0][line_], block_.xi[1][line_]}; }  ///< on the patch
    nurbs::Vector3 delta() const {  ///< from the foot to the centre [length]
      return {block_.delta[0][line_], block_.delta[1][line_], block_.delta[2][line_]};
    }
    double distance() const { return block_.distance[line_]; }  ///< [length]
    int slot() const { return marks_.slot; }
    search::FootStatus status() const {
      return marks_.on == On::edge ? search::FootStatus::edge : search::FootStatus::interior;
    }

   private:
    const FeetBlock& block_;
    int line_, face_, patch_;
    const Marks& marks_;
  };
  /// The nearest of a candidate; then the others.
  Foot foot(int k) const { return {block_, k, page_->face[k], page_->patch[k], page_->marks[k]}; }
  Foot foot(int k, int n) const {
    if (n == 0) return foot(k);
    const int line = first_other_[k] + n - 1, face = other_face_[line];
    return {others_, line, face, names_.patch_of(face), further_[page_->further[k] + n - 1].marks};
  }
  /// Whoever fills or clears that slot otherwise asks for feet anew.
  void settle(int k, int n, int slot) {
    Marks& marks = n == 0 ? page_->marks[k] : further_[page_->further[k] + n - 1].marks;
    NURBS_ASSERT(0 <= slot && slot <= std::numeric_limits<std::int16_t>::max(), slot);
    marks.slot = static_cast<std::int16_t>(slot);
  }
  /// Whether a slot has been on the foot's face, on a side that is known.
  bool has_been_on_face(const ContactSlot& slot, const Foot& foot) const {
    return slot.is_beside(foot.patch()) &&
           (!names_.parts || names_.parts->part_at(slot.foot()) == foot.face());
  }

 private:
  static constexpr int kNone = -1;
  static constexpr double kAway = -1.0;  // what lines reach that were not added

  // What the faces below lines have in common.
  struct Below {
    bool is_known = false, is_one_face = false, has_planes = false, has_others = false;
    bool has_several = false;  // some candidate has other feet
    int first = 0;             // a line that has one
  };
  // The nearest feet of kBlock candidates, number by number.
  struct Page {
    Page();
    struct Under {
      int piece, face, patch;
    };
    void set(int k, const Room& room, const Under& under, int side_of_face, const Marks& of_foot);
    void forget(int k);
    void look_below();

    KeptFeet kept;
    std::int32_t piece[kBlock], face[kBlock], patch[kBlock];  // or edge, and the face that has it
    Marks marks[kBlock];
    std::int32_t further[kBlock];  // in further_, of candidates that ever had several feet
    int count = 0;                 // of those that have a foot
    Below below;
  };
  // Of a plane or an edge below a foot, as KeptFeet has it; of others nothing.
  struct Ground {
    nurbs::Vector3 origin = nurbs::Vector3::Zero(), x = origin, y = origin;
    double scale[2] = {}, shift[2] = {};
    void copy_to(KeptFeet& kept, int k) const;
  };
  // Another foot of a candidate.
  struct Further {
    nurbs::Vector3 centre;
    double reach, margin, sign;
    Ground ground;
    std::int32_t piece, face;
    Marks marks;
  };
  // Feet of a block, and what is below them; piece < 0: there is none.
  struct Lines {
    FeetBlock& block;
    const KeptFeet& kept;
    const std::int32_t *piece, *face;
    const Marks* marks;
    const Below& below;
    bool has(int k) const { return piece[k] >= 0 && block.touch_reach[k] >= 0.0; }
    nurbs::Vector3 centre(int k) const {
      return {block.centre[0][k], block.centre[1][k], block.centre[2][k]};
    }
    double room_to_move(int k) const;
  };

  void set(Page& page, int k, const Room& room, int piece, int face, int side, const Marks& marks) const;
  Ground ground_of(On on, int piece, int face) const;
  Ground plane_ground(int piece, int face) const;
  Ground edge_ground(int edge, int face) const;
  Page& page_of(int candidate) {
    NURBS_ASSERT(candidate < static_cast<int>(pages_.size()) * kBlock, candidate, pages_.size());
    return pages_[candidate / kBlock];
  }
  static int line_of(int candidate) { return candidate % kBlock; }
  void add_others();
  void add_others(int k);
  int room_for_others();
  void find(const Lines& lines, const StepNumbers& step);
  void find_in_frame(const Lines& lines);
  void find_on_planes(const Lines& lines);
  void find_on_faces(const Lines& lines);
  bool find_on_one_cylinder(const Lines& lines);
  void find_on_chart(const Lines& lines, int k);
  void find_on_edge(const Lines& lines, int k);
  void find_on_patch(const Lines& lines, int k);
  static void set_foot(const Lines& lines, int k, double room, const nurbs::Vector3& delta, double distance,
                       const nurbs::Parameter<2>& xi);
  void bring_together(int k);

  const brep::FootSearch& search_;
  FaceNames names_;
  const std::vector<brep::Chart>* charts_;         // of these
  std::vector<Page> pages_, pages_before_;         // of the candidates, of this list and of the last
  std::vector<Further> further_, further_before_;  // kMostFeet - 1 for each that has had several feet
  struct Followed {
    nurbs::Parameter<2> xi;
    nurbs::Vector3 up;  // from the foot to the centre
  };
  std::vector<Followed> followed_;  // per candidate, of feet on patches

  FeetKernel kernel_;
  const coupling::RigidFrame* frame_ = nullptr;
  bool is_turned_ = false;
  Page* page_ = nullptr;  // of this block
  int first_ = 0;         // its first candidate
  FeetBlock block_;
  // The further feet of its candidates, where the first of each stands among them, and who has some.
  FeetBlock others_;
  KeptFeet others_kept_;
  std::int32_t other_piece_[kBlock] = {}, other_face_[kBlock] = {};
  Marks other_marks_[kBlock] = {};
  bool has_other_edges_ = false;
  int first_other_[kBlock] = {}, several_[kBlock] = {}, several_count_ = 0;
  FaceKernel face_kernel_;
  std::vector<FaceNumbers> faces_;  // of walls whose faces have no charts
  FaceBlock on_faces_;
};

}  // namespace contact
