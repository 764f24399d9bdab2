// SPDX-License-Identifier: GPL-2.0-or-later
// Brent's method and the simplex method on classical problems.
#include "search/brent.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "search/simplex.h"

namespace search {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr double kStep = 1.5e-8;

// Sweeps until x stops moving; their number.
template <class Equations>
int solve(const Equations& f, Vector2& x, int limit = 50) {
  for (int sweep = 1; sweep <= limit; ++sweep) {
    const Vector2 before = x;
    if (!brent_sweep(f, kStep, x)) return limit + 1;
    if ((x - before).norm() <= 1e-12 * x.norm()) return sweep;
  }
  return limit + 1;
}

TEST(Brent, SolvesALinearSystemInOneSweep) {
  Eigen::Matrix2d A;
  A << 3.0, -1.0, 2.0, 5.0;
  const Vector2 b(1.0, -4.0);
  Vector2 x(0.3, 0.7);
  ASSERT_TRUE(brent_sweep([&](int j, const Vector2& y) { return A.row(j).dot(y) - b[j]; }, kStep, x));
  EXPECT_LT((x - A.inverse() * b).norm(), 1e-7);
}

// Problems 1 and 3 of More, Garbow & Hillstrom (1981), "Testing unconstrained optimization software".
TEST(Brent, Rosenbrock) {
  const auto f = [](int j, const Vector2& x) { return j == 0 ? 10.0 * (x[1] - x[0] * x[0]) : 1.0 - x[0]; };
  Vector2 x(-1.2, 1.0);
  EXPECT_LE(solve(f, x), 20);
  EXPECT_LT((x - Vector2::Ones()).norm(), 1e-12);
}

TEST(Brent, PowellBadlyScaled) {
  const auto f = [](int j, const Vector2& x) {
    return j == 0 ? 1e4 * x[0] * x[1] - 1.0 : std::exp(-x[0]) + std::exp(-x[1]) - 1.0001;
  };
  Vector2 x(0.0, 1.0);
  EXPECT_LE(solve(f, x), 30);
  EXPECT_NEAR(x[0], 1.098159e-5, 1e-11);
  EXPECT_NEAR(x[1], 9.106146, 1e-5);
}

TEST(Brent, ConvergesQuadratically) {
  const Vector2 root(0.7, -0.4);
  const auto f = [&](int j, const Vector2& x) {
    return j == 0 ? x.squaredNorm() - root.squaredNorm()
                  : std::exp(x[0]) * std::cos(x[1]) - std::exp(root[0]) * std::cos(root[1]);
  };
  Vector2 x = root + Vector2(0.2, 0.15);
  std::vector<double> error;
  for (int sweep = 0; sweep < 4; ++sweep) {
    ASSERT_TRUE(brent_sweep(f, kStep, x));
    error.push_back((x - root).norm());
  }
  const double order = std::log(error[3] / error[2]) / std::log(error[2] / error[1]);
  EXPECT_GT(order, 1.8);
  EXPECT_LT(error[3], 1e-8);
}

TEST(Brent, ReportsEquationsWithoutSlope) {
  Vector2 x(1.0, 1.0);
  EXPECT_FALSE(brent_sweep([](int, const Vector2&) { return 1.0; }, kStep, x));
  x = {1.0, 1.0};  // the same equation twice
  EXPECT_FALSE(brent_sweep([](int, const Vector2& y) { return y[0] - 3.0; }, kStep, x));
}

// The triangle ends around the minimum: the best vertex is about its last edge away.
TEST(Simplex, EndsNearTheMinimum) {
  const Vector2 minimum(2.3, -1.7);
  const auto bowl = [&](const Vector2& x) {
    const Vector2 r = x - minimum;
    return 3.0 * r[0] * r[0] + r[0] * r[1] + r[1] * r[1];
  };
  for (int halvings : {2, 5, 10}) {
    const double last_edge = 0.5 * std::pow(0.5, halvings);
    const Vector2 x = simplex_minimum(bowl, {0.0, 0.0}, {0.5, -0.5}, halvings);
    EXPECT_LT((x - minimum).norm(), 2.0 * last_edge) << halvings;
  }
}

// In a valley askew the worst vertex alone gets stuck early; the second worst tumbles on.
TEST(Simplex, FollowsAValley) {
  const auto valley = [](const Vector2& x) {
    return std::pow(x[0] + x[1], 2) + 0.04 * std::pow(x[0] - x[1], 2);
  };
  for (double angle = 0.0; angle < 6.0; angle += 0.5) {
    const Vector2 x = simplex_minimum(valley, {3.0 * std::cos(angle), 3.0 * std::sin(angle)}, {0.5, 0.5}, 5);
    EXPECT_LT(valley(x), 2e-3) << angle;
  }
}

TEST(Simplex, StaysWhereTheFunctionIsFinite) {
  const Vector2 minimum(0.02, -0.01);
  const auto f = [&](const Vector2& x) {
    return x[0] < 0.0 ? std::numeric_limits<double>::infinity() : (x - minimum).squaredNorm();
  };
  const Vector2 x = simplex_minimum(f, {1.0, 1.0}, {0.5, 0.5}, 8);
  EXPECT_GE(x[0], 0.0);
  EXPECT_LT((x - minimum).norm(), 0.005);
}

}  // namespace
}  // namespace search
