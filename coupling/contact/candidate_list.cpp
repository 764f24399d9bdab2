// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/candidate_list.h"

namespace contact {

using nurbs::Vector3;

void CandidateList::build(const coupling::RigidFrame& frame, const std::vector<Vector3>& images,
                          const Surroundings& particles, const Near& near) {
  frame_at_build_ = frame;
  images_ = images;
  candidates_.clear();
  image_elements_.clear();
  elements_.clear();
  for (int i = 0; i < particles.count; ++i) {
    const int first_image = static_cast<int>(image_elements_.size());
    for (size_t image = 0; image < images.size(); ++image) {
      const int first = static_cast<int>(elements_.size());
      near(i, frame.to_body(Vector3::Map(particles.centre + 3 * i) - images[image]), particles.reach[i],
           elements_);
      const int count = static_cast<int>(elements_.size()) - first;
      if (count > 0) image_elements_.push_back({static_cast<int>(image), first, count});
    }
    const int image_count = static_cast<int>(image_elements_.size()) - first_image;
    if (image_count > 0) candidates_.push_back({i, first_image, image_count});
  }
}

}  // namespace contact
