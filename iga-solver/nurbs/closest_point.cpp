// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/closest_point.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "nurbs/box_tree.h"
#include "nurbs/foot_search.h"

namespace nurbs {
namespace {

constexpr int kMaxIterations = 100;

// A closed grid of samples on one element: its local minima are where descents start.
class ElementGrid {
 public:
  ElementGrid(const Space<2>& space, const NodalVectors& control_points, const Vector3& d, int element)
      : space_(space),
        element_(space.element_indices(element)),
        n_{space.degree(0) + 2, space.degree(1) + 2} {
    RationalBasis<2> basis;
    for (int k = 0; k < size(); ++k) {
      evaluate_on_element(space, element, parameter(k), 0, basis);
      distance2_[k] = (interpolate(basis, control_points) - d).squaredNorm();
    }
  }

  int size() const { return n_[0] * n_[1]; }
  Parameter<2> parameter(int k) const {
    const int position[2] = {k % n_[0], k / n_[0]};
    Parameter<2> xi;
    for (int i = 0; i < 2; ++i) {
      const double* knot = &space_.knots(i).breaks()[element_[i]];
      xi[i] = knot[0] + (knot[1] - knot[0]) * position[i] / (n_[i] - 1);
    }
    return xi;
  }
  // Not above any of the up to eight neighbours; of equal ones the first counts.
  bool local_minimum(int k) const {
    const int column = k % n_[0], row = k / n_[0];
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, n_[1] - 1); ++j)
      for (int i = std::max(column - 1, 0); i <= std::min(column + 1, n_[0] - 1); ++i) {
        const int other = i + n_[0] * j;
        if (other < k ? distance2_[other] <= distance2_[k] : distance2_[other] < distance2_[k]) return false;
      }
    return true;
  }

 private:
  const Space<2>& space_;
  Indices<2> element_;
  int n_[2];
  double distance2_[power(kMaxDegree + 2, 2)];
};

}  // namespace

Projection closest_point_from(const Space<2>& space, const NodalVectors& control_points, const Vector3& d,
                              const Parameter<2>& guess) {
  const Eigen::Vector2d u(guess[0], guess[1]);
  FootSearch search(space, control_points, d, u, region_between_creases(space, u));
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const bool lower =
        search.descend() || search.cross_crease() || search.leave_saddle() || search.leave_pole();
    if (!lower) return search.result(iteration, true);
  }
  return search.result(kMaxIterations, false);
}

Projection closest_point_on_elements(const Space<2>& space, const NodalVectors& control_points,
                                     const Vector3& d, const int* elements, int element_count) {
  if (element_count < 1) throw std::invalid_argument("no elements given, expected at least 1");
  Projection best = closest_point_from(space, control_points, d, space.element_centre(elements[0]));
  for (int k = 0; k < element_count; ++k) {
    const Box box = element_box(space, control_points, elements[k]);
    if (box.squared_distance(d) >= best.distance * best.distance) continue;
    // A descent is first kept to its element, so that it cannot run away and miss what is here.
    const SmoothRegion region = region_of_element(space, elements[k]);
    const ElementGrid grid(space, control_points, d, elements[k]);
    for (int start = 0; start < grid.size(); ++start) {
      if (!grid.local_minimum(start)) continue;
      const Parameter<2> xi = grid.parameter(start);
      FootSearch search(space, control_points, d, {xi[0], xi[1]}, region);
      for (int iteration = 0; iteration < kMaxIterations; ++iteration)
        if (!search.descend() && !search.leave_saddle()) break;
      const Projection foot =
          closest_point_from(space, control_points, d, {search.at().u[0], search.at().u[1]});
      if (foot.distance < best.distance) best = foot;
    }
  }
  return best;
}

}  // namespace nurbs
