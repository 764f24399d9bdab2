// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/node_set.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace structure {

NodeSet nodes_on(const nurbs::Space<3>& volume, const std::vector<nurbs::Face>& faces) {
  NodeSet common(volume.control_point_count());
  std::iota(common.begin(), common.end(), 0);
  for (const nurbs::Face face : faces) {
    NodeSet on_face = nurbs::boundary_surface(volume, face).volume_control_point, both;
    std::sort(on_face.begin(), on_face.end());
    std::set_intersection(common.begin(), common.end(), on_face.begin(), on_face.end(),
                          std::back_inserter(both));
    common = std::move(both);
  }
  return common;
}

NodeSet nodes_within(const nurbs::NodalVectors& positions, const nurbs::Vector3& low,
                     const nurbs::Vector3& high) {
  NodeSet inside;
  for (int A = 0; A < positions.cols(); ++A)
    if ((positions.col(A).array() >= low.array()).all() && (positions.col(A).array() <= high.array()).all())
      inside.push_back(A);
  return inside;
}

}  // namespace structure
