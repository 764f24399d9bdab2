// SPDX-License-Identifier: GPL-2.0-or-later
// Which particles may touch the wall until the next rebuild, and which surface elements they may touch.
// Source: Gao & Feng (2019), section 4.1; control-point boxes and trees in place of their CGRID.
#pragma once

#include <functional>
#include <vector>

#include "coupling/rigid_frame.h"
#include "nurbs/assert.h"
#include "nurbs/types.h"

namespace contact {

/// Elements near one particle, of the surface moved by one period of the box (or by 0).
struct ImageElements {
  int image;         ///< index in CandidateList::images()
  int first, count;  ///< range in CandidateList::elements()
};
struct Candidate {
  int particle;                  ///< local index, valid until LIGGGHTS exchanges or sorts its particles
  int first_image, image_count;  ///< range in CandidateList::image_elements()
};

/// Centres of particles, rows of three, and how far around each to look [length], or kNotAtAll.
struct Surroundings {
  int count;
  const double* centre;
  const double* reach;
};

class CandidateList {
 public:
  static constexpr double kNotAtAll = -1.0;
  /// Adds the numbers, in rising order, of all elements that may be within `reach` of a point in the wall's
  /// frame, where that particle is, or an image of it.
  using Near =
      std::function<void(int particle, const nurbs::Vector3& point, double reach, std::vector<int>& out)>;
  /// Whether all of these elements that are within `reach` of a point in the wall's frame are others of the
  /// wall when they are moved by `shift`.
  using Repeats = std::function<bool(const nurbs::Vector3& shift, const nurbs::Vector3& point, double reach,
                                     const int* elements, int count)>;
  /// Each particle becomes a candidate of the elements that, moved by one of the images, are within its
  /// reach; images all of whose elements near it repeat those of another are left out.
  void build(const coupling::RigidFrame& frame, const std::vector<nurbs::Vector3>& images,
             const Surroundings& particles, const Near& near, const Repeats& repeats);

  const std::vector<Candidate>& candidates() const { return candidates_; }
  const std::vector<nurbs::Vector3>& images() const { return images_; }  ///< in space [length]
  std::size_t image_element_count() const { return image_elements_.size(); }
  const ImageElements* image_elements(const Candidate& c) const {
    NURBS_ASSERT(c.first_image + c.image_count <= static_cast<int>(image_elements_.size()), c.first_image);
    return &image_elements_[c.first_image];
  }
  const int* elements(const ImageElements& e) const {
    NURBS_ASSERT(e.first + e.count <= static_cast<int>(elements_.size()), e.first, e.count);
    return elements_.data() + e.first;
  }

  /// All elements of all candidates, each perhaps many times.
  const std::vector<int>& all_elements() const { return elements_; }

  /// Where the wall was when it was built.
  const coupling::RigidFrame& frame_at_build() const { return frame_at_build_; }

 private:
  void leave_out_repeats(int first_image, const nurbs::Vector3& centre, double reach, const Repeats& repeats);

  std::vector<Candidate> candidates_;
  std::vector<ImageElements> image_elements_;
  std::vector<int> elements_;
  std::vector<nurbs::Vector3> images_;
  coupling::RigidFrame frame_at_build_;
};

}  // namespace contact
