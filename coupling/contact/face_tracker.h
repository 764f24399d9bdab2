// SPDX-License-Identifier: GPL-2.0-or-later
// The feet of candidates on a wall of faces, edges and vertices.
//
// A foot costs little here, so none is followed: all are found anew in each step that may have one.  Near
// the wall a candidate looks only at the pieces that it can reach before it has moved by a small part of its
// radius, the smaller the slower it is; farther away it looks for the nearest piece alone, and then rests
// until it can be there.  Most that touch do so inside faces, and go on to do so: steady_feet.h finds these
// contacts, and nobody looks at others.  A branch is a foot of one sheet (brep/README.md), wherever it moves
// on it, over edges and vertices too.  Bodies have one side: a branch whose centre has passed their skin
// stays, with a distance less than 0, until the centre is out again or farther in than the particle reaches.
#pragma once

#include <vector>

#include "brep/foot_search.h"
#include "coupling/contact/face_names.h"
#include "coupling/contact/feet_tracker.h"
#include "coupling/contact/search_counts.h"

namespace contact {

class FaceTracker : public FeetTracker {
 public:
  /// Keeps references to all.
  FaceTracker(const brep::FootSearch& search, const FaceNames& names, const CandidateList& candidates,
              SearchCounts& counts)
      : FeetTracker(candidates), search_(search), names_(names), counts_(counts), steady_(search, names) {}

  void list_is_new() override;
  void go_on(const Listed& particles) override;
  SteadyFeet* steady() override { return &steady_; }
  void follow(Query* queries, int count) override;
  FeetRange feet(const Query& query, const ParticleSlots& slots) override;

 protected:
  const brep::FootSearch& search() const { return search_; }
  SearchCounts& counts() { return counts_; }
  /// What it knows of a candidate; slots stay.
  void forget(const Query& query) {
    states_[query.candidate] = State();
    steady_.forget(query.candidate);
  }

 private:
  struct State {
    nurbs::Vector3 centre = nurbs::Vector3::Zero();  // when its pieces were chosen
    double reach = 0.0;                              // then; 0: not yet [length]
    nurbs::Vector3 last = nurbs::Vector3::Zero();    // its foot when it was found last, if it had one alone
    int sheet = -1;                                  // of that; -1: none, or its list is new
    int looks = 0, next_try = 0;                     // at these pieces; when to ask whether it may rest
    int alone = -1;       // one of these, if all are of one face, which the candidate is well inside of ...
    double margin = 0.0;  // ... as long as it has not moved by more
  };
  // Of a candidate when the list was built.
  struct Known {
    int particle, tag;
    nurbs::Vector3 centre;  // in the wall's frame
    double reach;           // all pieces within are in the list [length]
    int first, count;       // its range in pieces_ and in piece_counts_; -1: images of the wall are near
  };
  enum class Of { list, chosen };
  /// f(centre less the image, pieces, their number, image) for each image near the candidate.
  template <class Function>
  void for_each_image(const Query& query, Of of, Function f) const {
    const Candidate& candidate = candidates_.candidates()[query.candidate];
    const ImageElements* images = candidates_.image_elements(candidate);
    for (int k = 0; k < candidate.image_count; ++k) {
      const ImageElements& at = images[k];
      const nurbs::Vector3& image = candidates_.images()[at.image];
      if (of == Of::list)
        f(query.centre - image, candidates_.elements(at), at.count, image);
      else
        f(query.centre - image, pieces_.data() + at.first, piece_counts_[candidate.first_image + k], image);
    }
  }
  double nearest(const Query& query, double reach, Of of) const;
  double nearest_of_chosen(const Query& query) const;
  struct PiecesHere {
    const int* first = nullptr;
    int count = 0;
  };
  void leave_out_images_in_its_face(const Query& query);
  PiecesHere pieces_of_wall_itself(const Query& query) const;
  bool is_near_wall_itself(const Candidate& candidate) const;
  void go_on(int candidate, int before);
  bool is_near_patch(const Candidate& candidate, const Known& known) const;
  void choose_fewer_pieces(const Query& query);
  void choose_pieces(const Query& query);
  void choose_pieces(const Query& query, Of of, double margin);
  static bool has_moved_less(const Query& query, const State& state, double than);
  void prefetch(const Query& query) const;
  FeetRange feet_of_fast(const Query& query, const ParticleSlots& slots);
  void find(const Query& query, double reach, double margin = 0.0);
  bool may_be_behind(const Query& query, const ParticleSlots& slots) const;
  void add_feet_behind(const Query& query, const ParticleSlots& slots);
  void drop_feet_through_bodies(const Query& query);
  void keep_feet_of_all_images(const Query& query);
  double squared_way(const Query& query, const nurbs::Vector3& last, const nurbs::Vector3& now) const;
  double squared_way(const Query& query, const ContactSlot& slot, const brep::Foot& foot) const;
  void match_slots(const Query& query, const ParticleSlots& slots);
  bool is_last_foot(const Query& query, const ParticleSlots& slots) const;
  void match_nearest(const Query& query, const ParticleSlots& slots);
  static bool lasts(const Query& query, double room);
  double margin_to_rest(const Query& query) const;
  bool may_rest(const Query& query);
  TrackedFoot tracked(const brep::Foot& foot) const;
  FeetRange none(const Query& query, const ParticleSlots& slots, double clearance);

  const brep::FootSearch& search_;
  FaceNames names_;
  SearchCounts& counts_;
  SteadyFeet steady_;
  std::vector<State> states_, states_before_;  // per candidate, of this list and of the last
  std::vector<Known> known_, known_before_;    // likewise
  std::vector<int> of_particle_;               // its candidate in the last list; -1: none
  std::vector<int> pieces_;        // those chosen, of each image at the beginning of its range of elements
  std::vector<int> piece_counts_;  // of these, per image of each candidate
  std::vector<int> pieces_before_, counts_before_;
  std::vector<brep::Foot> found_;   // of one candidate, in this step; so are the next two
  std::vector<brep::Foot> near_;    // the same, but that do not touch
  double room_ = 0.0;               // how far it may move until others come near them; 0: not known
  std::vector<brep::Foot> beside_;  // where one of these is on an edge, of another image
  std::vector<TrackedFoot> feet_;   // the same
  struct Pair {
    double way2;
    int slot, foot;
  };
  std::vector<Pair> pairs_;
};

}  // namespace contact
