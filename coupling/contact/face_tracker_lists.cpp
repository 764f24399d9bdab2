// SPDX-License-Identifier: GPL-2.0-or-later
// What is known of candidates when their list is new.
#include <algorithm>

#include "coupling/contact/face_tracker.h"

namespace contact {

void FaceTracker::list_is_new() {
  FeetTracker::list_is_new();
  states_.swap(states_before_), pieces_.swap(pieces_before_), piece_counts_.swap(counts_before_);
  states_.assign(candidates_.candidates().size(), State());
  steady_.forget_all(states_.size());
  pieces_.resize(candidates_.all_elements().size());
  piece_counts_.resize(candidates_.image_element_count());
}

// Lists are built for the fastest particle; most have hardly moved, and the wall has not in its frame.
void FaceTracker::go_on(const Listed& particles) {
  known_.swap(known_before_);
  known_.clear();
  of_particle_.clear();
  for (std::size_t before = 0; before < known_before_.size(); ++before) {
    const std::size_t particle = known_before_[before].particle;
    if (particle >= of_particle_.size()) of_particle_.resize(particle + 1, -1);
    of_particle_[particle] = static_cast<int>(before);
  }
  const std::vector<Candidate>& all = candidates_.candidates();
  for (int c = 0; c < static_cast<int>(all.size()); ++c) {
    const int i = all[c].particle;
    const nurbs::Vector3 centre =
        candidates_.frame_at_build().to_body(nurbs::Vector3::Map(particles.x + 3 * i));
    const bool itself = is_near_wall_itself(all[c]);
    known_.push_back({i, particles.tag[i], centre, particles.reach[i],
                      itself ? candidates_.image_elements(all[c])->first : -1, all[c].first_image});
    const int before = i < static_cast<int>(of_particle_.size()) ? of_particle_[i] : -1;
    if (itself && before >= 0 && !is_near_patch(all[c], known_.back())) go_on(c, before);
  }
}

// There the last digits of feet are those of where they were followed from, and since when: a particle that
// comes from another rank, of which nothing is known here, must have the same.
bool FaceTracker::is_near_patch(const Candidate& candidate, const Known& known) const {
  const brep::Surface& surface = search_.surface();
  if (!surface.patches) return false;
  const ImageElements& itself = *candidates_.image_elements(candidate);
  const int* const listed = candidates_.elements(itself);
  return std::any_of(listed, listed + itself.count, [&](int number) {
    const brep::Piece& piece = surface.pieces[number];
    if (piece.kind != brep::Piece::Kind::element) return false;
    const brep::ElementHull& hull = surface.patches->hull(surface.faces[piece.face].patch, piece.element());
    return hull.squared_distance(known.centre) <= known.reach * known.reach;
  });
}

void FaceTracker::go_on(int candidate, int before) {
  const Known &now = known_[candidate], &then = known_before_[before];
  if (then.tag != now.tag || then.first < 0) return;
  go_on_quietly(candidate, before, then.centre, then.reach);
  const int count = counts_before_[then.count];
  State state = states_before_[before];
  state.reach =
      std::min(state.reach, then.reach - 2.0 * search_.border_slack() - (state.centre - then.centre).norm());
  if (!(state.reach > 0.0) || count > candidates_.image_elements(candidates_.candidates()[candidate])->count)
    return;
  state.sheet = -1;
  states_[candidate] = state;
  std::copy_n(pieces_before_.begin() + then.first, count, pieces_.begin() + now.first);
  piece_counts_[now.count] = count;
  steady_.go_on(candidate, before, then.centre, then.reach - 2.0 * search_.border_slack());
}

}  // namespace contact
