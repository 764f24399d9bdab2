// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/plate_patch.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace structure {

int thickness_direction(const nurbs::Space<3>& space) {
  int direction = -1, found = 0;
  for (int d = 0; d < 3; ++d)
    if (space.degree(d) == 2 && space.knots(d).element_count() == 1) {
      direction = d;
      ++found;
    }
  return found == 1 ? direction : -1;
}

Vector3 layer_normal(const nurbs::Volume& patch, int direction, const nurbs::Parameter<3>& xi) {
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(patch.space, xi, 1, basis);
  const auto tangent = [&](int turn) {
    const double* const slopes = basis.dR[(direction + turn) % 3];
    Vector3 sum = Vector3::Zero();
    for (int a = 0; a < basis.count; ++a) sum += slopes[a] * patch.control_points.col(basis.control_point[a]);
    return sum;
  };
  return tangent(1).cross(tangent(2)).normalized();
}

// Whatever the outline: along the normal all then depends on one parameter alone, and evenly.
Vector3 plate_normal(const nurbs::Volume& patch, int direction) {
  constexpr double kFlat = 1e-6;  // of the thickness
  const nurbs::Space<3>& space = patch.space;
  const Vector3 n = layer_normal(patch, direction, space.element_centre(0));
  std::array<double, 3> low, high;
  low.fill(HUGE_VAL), high.fill(-HUGE_VAL);
  const int before = direction == 0   ? 1
                     : direction == 1 ? space.control_point_count(0)
                                      : space.control_point_count(0) * space.control_point_count(1);
  for (int a = 0; a < space.control_point_count(); ++a) {
    const int layer = a / before % 3;
    const double height = n.dot(patch.control_points.col(a));
    low[layer] = std::min(low[layer], height), high[layer] = std::max(high[layer], height);
  }
  const double thickness = high[2] - low[0], limit = kFlat * thickness;
  for (int layer = 0; layer < 3; ++layer)
    if (!(high[layer] - low[layer] <= limit))
      throw std::invalid_argument(fmt::format(
          "is one quadratic element thick and no flat plate (a layer of its control points leaves its "
          "plane by {:.2g} of the thickness), expected one, or degree 3 through the thickness",
          (high[layer] - low[layer]) / thickness));
  if (!(std::abs(low[1] - 0.5 * (low[0] + low[2])) <= limit))
    throw std::invalid_argument(
        fmt::format("has its middle layer of control points at {:.2g} of the thickness, expected 0.5",
                    (low[1] - low[0]) / thickness));
  return n;
}

}  // namespace structure
