// SPDX-License-Identifier: GPL-2.0-or-later
// Feet where images of the wall are near, across the periodic faces of the box.
#include <algorithm>
#include <cmath>

#include "brep/face_shape.h"
#include "coupling/contact/face_tracker.h"

namespace contact {

using nurbs::Vector3;

// A wall that is longer than a periodic box lies on itself: an image has no other feet there.
void FaceTracker::leave_out_images_in_its_face(const Query& query) {
  const State& state = states_[query.candidate];
  const Candidate& candidate = candidates_.candidates()[query.candidate];
  const ImageElements* const images = candidates_.image_elements(candidate);
  int* const counts = &piece_counts_[candidate.first_image];
  const int* const own = pieces_.data() + images->first;
  if (!candidates_.images()[images->image].isZero(0.0) || counts[0] == 0 ||
      !search_.is_well_inside(own, counts[0], query.centre, state.reach, state.margin))
    return;
  for (int k = 1; k < candidate.image_count; ++k)
    if (search_.is_repeated(*own, candidates_.images()[images[k].image], pieces_.data() + images[k].first,
                            counts[k]))
      counts[k] = 0;
}

// Those chosen, if none of its images is near.
FaceTracker::PiecesHere FaceTracker::pieces_of_wall_itself(const Query& query) const {
  const Candidate& candidate = candidates_.candidates()[query.candidate];
  const ImageElements* const images = candidates_.image_elements(candidate);
  const int* const counts = &piece_counts_[candidate.first_image];
  const auto is_near = [](int count) { return count > 0; };
  if (!candidates_.images()[images->image].isZero(0.0) ||
      std::any_of(counts + 1, counts + candidate.image_count, is_near))
    return {};
  return {pieces_.data() + images->first, *counts};
}

bool FaceTracker::is_near_wall_itself(const Candidate& candidate) const {
  return candidate.image_count == 1 &&
         candidates_.images()[candidates_.image_elements(candidate)->image].isZero(0.0);
}

// Concave edges between images have feet of both faces, as edges of the wall have: an image goes on where the
// centre is not less steep above it.
void FaceTracker::keep_feet_of_all_images(const Query& query) {
  const brep::Surface& surface = search_.surface();
  FeetTracker::keep_feet_of_all_images(query, found_, [&](const brep::Foot& foot, const ImageElements& at) {
    const Vector3 up = (query.centre - foot.point).normalized();
    const auto slant = [&](const brep::Foot& on) {
      return std::acos(std::min(1.0, std::abs(up.dot(brep::normal_on(surface, on.patch, on.xi)))));
    };
    const double same = same_place(query);
    beside_.clear();
    search_.feet(foot.point - candidates_.images()[at.image] + 0.5 * same * up, same,
                 candidates_.elements(at), at.count, beside_);
    return std::any_of(beside_.begin(), beside_.end(), [&](const brep::Foot& other) {
      return slant(other) <= slant(foot) + surface.edge_angle;
    });
  });
}

}  // namespace contact
