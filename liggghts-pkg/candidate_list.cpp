// SPDX-License-Identifier: GPL-2.0-or-later
#include "candidate_list.h"

#include <cmath>

namespace liggghts_pkg {

void CandidateList::build(const nurbs::Space<2>& space, const nurbs::NodalVectors& control_points, int n,
                          const double* const* x, const double* radius, double radius_factor, double skin) {
  nurbs::element_boxes(space, control_points, boxes_);
  tree_.build(boxes_);
  control_points_at_build_ = control_points;

  candidates_.clear();
  elements_.clear();
  for (int i = 0; i < n; ++i) {
    const int first = static_cast<int>(elements_.size());
    tree_.query(nurbs::Vector3::Map(x[i]), radius[i] * radius_factor + skin, elements_);
    const int count = static_cast<int>(elements_.size()) - first;
    if (count > 0) candidates_.push_back({i, first, count});
  }
}

double CandidateList::motion_since_build(const nurbs::NodalVectors& control_points) const {
  return std::sqrt(
      (control_points - control_points_at_build_).colwise().squaredNorm().maxCoeff<Eigen::PropagateNaN>());
}

}  // namespace liggghts_pkg
