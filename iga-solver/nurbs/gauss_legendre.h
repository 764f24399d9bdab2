// SPDX-License-Identifier: GPL-2.0-or-later
// Gauss-Legendre quadrature.
#pragma once

#include <vector>

namespace nurbs {

constexpr int kMaxGaussPoints = 8;

struct QuadratureRule {
  std::vector<double> points;   ///< on (-1, 1), rising
  std::vector<double> weights;  ///< sum 2
};

/// The rule of n points, exact for polynomials of degree 2n - 1.  Its points are the roots of the Legendre
/// polynomial P_n, found by Newton's method (Davis & Rabinowitz, Methods of Numerical Integration, 1984,
/// section 2.7). Throws std::invalid_argument unless 1 <= n <= kMaxGaussPoints.
QuadratureRule gauss_legendre(int n);
/// The same rule on [low, high]: the weights sum to high - low.
QuadratureRule gauss_legendre(int n, double low, double high);

}  // namespace nurbs
