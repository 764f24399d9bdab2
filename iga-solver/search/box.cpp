// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/box.h"

namespace search {

Box element_box(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points, int element) {
  int indices[power(kMaxDegree + 1, 2)];
  space.element_control_points(element, indices);
  Box box{control_points.col(indices[0]), control_points.col(indices[0])};
  for (int a = 1; a < space.functions_per_element(); ++a) {
    box.low = box.low.cwiseMin(control_points.col(indices[a]));
    box.high = box.high.cwiseMax(control_points.col(indices[a]));
  }
  return box;
}

}  // namespace search
