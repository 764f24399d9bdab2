// SPDX-License-Identifier: GPL-2.0-or-later
// A curved rational surface for the tests: degree 2 x 3, uneven knots, weights between 0.6 and 1.4.
#pragma once

#include <cmath>

#include "nurbs/primitives.h"

namespace test {

inline nurbs::Surface wavy_surface() {
  const nurbs::KnotVector u = nurbs::KnotVector::from_breaks(2, {0.0, 0.2, 0.5, 0.6, 1.0});
  const nurbs::KnotVector v = nurbs::KnotVector::from_breaks(3, {0.0, 0.3, 0.7, 1.0});
  const nurbs::Surface flat = nurbs::plane({-1, 0, 0}, {2, 0, 0}, {0.3, 1.5, 0}, {u, v});
  nurbs::NodalVectors x = flat.control_points;
  std::vector<double> weights(x.cols());
  for (int a = 0; a < x.cols(); ++a) {
    x(2, a) = 0.3 * std::sin(2.0 * x(0, a)) * std::cos(3.0 * x(1, a));
    weights[a] = 1.0 + 0.4 * std::sin(1.7 * a);
  }
  return {nurbs::Space<2>({u, v}, weights), x};
}

}  // namespace test
