// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/gauss_legendre.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace nurbs {

namespace {

struct LegendreValue {
  double P, dP;
};

// P_n and its derivative at x, |x| < 1: (k+1) P_{k+1} = (2k+1) x P_k - k P_{k-1}; (1 - x^2) P_n' = n (P_{n-1}
// - x P_n).
LegendreValue legendre(int n, double x) {
  double P = 1.0, P_previous = 0.0;
  for (int k = 0; k < n; ++k) {
    const double P_next = ((2 * k + 1) * x * P - k * P_previous) / (k + 1);
    P_previous = P;
    P = P_next;
  }
  return {P, n * (P_previous - x * P) / (1.0 - x * x)};
}

}  // namespace

QuadratureRule gauss_legendre(int n) {
  if (n < 1 || n > kMaxGaussPoints)
    throw std::invalid_argument(
        fmt::format("gauss_legendre: {} points, expected 1 to {}", n, kMaxGaussPoints));
  const double pi = std::acos(-1.0);
  QuadratureRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5));  // within the basin of quadratic convergence of root i
    for (int iteration = 0; iteration < 6; ++iteration) {
      const LegendreValue value = legendre(n, x);
      x -= value.P / value.dP;
    }
    const double dP = legendre(n, x).dP;
    rule.points[i] = x;
    rule.weights[i] = 2.0 / ((1.0 - x * x) * dP * dP);
  }
  return rule;
}

QuadratureRule gauss_legendre(int n, double low, double high) {
  QuadratureRule rule = gauss_legendre(n);
  for (double& x : rule.points) x = 0.5 * ((1.0 - x) * low + (1.0 + x) * high);
  for (double& w : rule.weights) w *= 0.5 * (high - low);
  return rule;
}

}  // namespace nurbs
