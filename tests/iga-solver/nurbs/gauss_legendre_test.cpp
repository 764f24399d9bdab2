// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "nurbs/gauss_legendre.h"

namespace {

using nurbs::gauss_legendre;
using nurbs::QuadratureRule;

double integrate_power(const QuadratureRule& rule, int power) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    sum += rule.weights[i] * std::pow(rule.points[i], power);
  return sum;
}

TEST(GaussLegendre, IntegratesPolynomialsExactlyUpToDegree2nMinus1AndNoFurther) {
  for (int n = 1; n <= nurbs::kMaxGaussPoints; ++n) {
    const QuadratureRule rule = gauss_legendre(n);
    for (int power = 0; power < 2 * n; ++power)
      EXPECT_NEAR(integrate_power(rule, power), power % 2 ? 0.0 : 2.0 / (power + 1), 1e-15 * (n + 1))
          << "n " << n << " power " << power;
    EXPECT_GT(std::abs(integrate_power(rule, 2 * n) - 2.0 / (2 * n + 1)), 1e-6);
  }
}

TEST(GaussLegendre, ThreePointsHaveTheirClosedForm) {
  const QuadratureRule rule = gauss_legendre(3);
  EXPECT_NEAR(rule.points[0], -std::sqrt(0.6), 1e-15);
  EXPECT_NEAR(rule.points[1], 0.0, 1e-15);
  EXPECT_NEAR(rule.weights[1], 8.0 / 9.0, 1e-15);
}

TEST(GaussLegendre, MapsToAnInterval) {
  EXPECT_NEAR(integrate_power(gauss_legendre(4, 2.0, 5.0), 7), (std::pow(5.0, 8) - std::pow(2.0, 8)) / 8,
              1e-9);
}

TEST(GaussLegendre, RefusesSizesItDoesNotHave) {
  EXPECT_THROW(gauss_legendre(0), std::invalid_argument);
  EXPECT_THROW(gauss_legendre(nurbs::kMaxGaussPoints + 1), std::invalid_argument);
}

}  // namespace
