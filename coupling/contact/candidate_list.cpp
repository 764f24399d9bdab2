// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/candidate_list.h"

#include <algorithm>

namespace contact {

using nurbs::Vector3;

void CandidateList::build(const coupling::RigidFrame& frame, const std::vector<Vector3>& images,
                          const Surroundings& particles, const Near& near, const Repeats& repeats) {
  frame_at_build_ = frame;
  images_ = images;
  candidates_.clear();
  image_elements_.clear();
  elements_.clear();
  for (int i = 0; i < particles.count; ++i) {
    if (particles.reach[i] == kNotAtAll) continue;
    const int first_image = static_cast<int>(image_elements_.size());
    for (size_t image = 0; image < images.size(); ++image) {
      const int first = static_cast<int>(elements_.size());
      near(i, frame.to_body(Vector3::Map(particles.centre + 3 * i) - images[image]), particles.reach[i],
           elements_);
      const int count = static_cast<int>(elements_.size()) - first;
      if (count > 0) image_elements_.push_back({static_cast<int>(image), first, count});
    }
    leave_out_repeats(first_image, Vector3::Map(particles.centre + 3 * i), particles.reach[i], repeats);
    const int image_count = static_cast<int>(image_elements_.size()) - first_image;
    if (image_count > 0) candidates_.push_back({i, first_image, image_count});
  }
}

// Of a particle, whose images begin there; the wall itself stays, if it can.
void CandidateList::leave_out_repeats(int first_image, const Vector3& centre, double reach,
                                      const Repeats& repeats) {
  for (auto k = static_cast<int>(image_elements_.size()) - 1; k >= first_image; --k) {
    const ImageElements at = image_elements_[k];
    const Vector3& image = images_[at.image];
    const auto first = image_elements_.begin() + first_image;
    if (std::any_of(first, image_elements_.end(), [&](const ImageElements& other) {
          return other.image != at.image &&
                 repeats(image - images_[other.image], frame_at_build_.to_body(centre - image), reach,
                         elements(at), at.count);
        }))
      image_elements_.erase(image_elements_.begin() + k);
  }
}

}  // namespace contact
