// SPDX-License-Identifier: GPL-2.0-or-later
// Feet where images of the wall are near, across the periodic faces of the box.
#include <algorithm>
#include <cmath>

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

// Where the wall goes on with one of its images, across a periodic face of the box, neither knows the other:
// a foot on the rim of the one is none if it lies in the plane that touches the other at a nearer foot, or in
// that foot.
void FaceTracker::keep_one_at_seams() {
  const auto repeats = [&](const brep::Foot& rim, const brep::Foot& nearer) {
    if (rim.image == nearer.image) return false;
    const double apart2 = (rim.point - nearer.point).squaredNorm(), same = search_.same_point();
    if (apart2 <= same * same) return true;
    const double out_of_plane = rim.distance * rim.distance - nearer.distance * nearer.distance - apart2;
    return rim.status != search::FootStatus::interior && std::abs(out_of_plane) <= 2.0 * rim.distance * same;
  };
  if (found_.size() < 2) return;
  auto end = found_.begin() + 1;
  for (auto foot = end; foot != found_.end(); ++foot)
    if (std::none_of(found_.begin(), end, [&](const brep::Foot& kept) { return repeats(*foot, kept); }))
      *end++ = *foot;
  found_.erase(end, found_.end());
}

// Where the wall and an image of it lie on each other neither ends.
void FaceTracker::drop_covered_rims(const Query& query) {
  const auto is_covered = [&](const brep::Foot& foot) {
    if (!search_.is_on_rim(foot)) return false;
    beside_.clear();
    for_each_image(query, Of::list, [&](const Vector3&, const int* pieces, int count, const Vector3& image) {
      if (image != foot.image)
        search_.feet(foot.point - image, kCovered * query.touch_reach, pieces, count, beside_);
    });
    return std::any_of(beside_.begin(), beside_.end(),
                       [&](const brep::Foot& other) { return !search_.is_on_rim(other); });
  };
  found_.erase(std::remove_if(found_.begin(), found_.end(), is_covered), found_.end());
}

}  // namespace contact
