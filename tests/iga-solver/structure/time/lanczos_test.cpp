// SPDX-License-Identifier: GPL-2.0-or-later
// The operator is a diagonal matrix: its eigenvectors are the axes.
#include "structure/time/lanczos.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

namespace {

using Eigen::VectorXd;
using structure::Tridiagonal;

Tridiagonal lanczos(const VectorXd& eigenvalues, VectorXd q, int steps) {
  Tridiagonal T;
  VectorXd before = VectorXd::Zero(q.size());
  q.normalize();
  for (int k = 0; k < steps; ++k) {
    VectorXd w = eigenvalues.cwiseProduct(q) - (k > 0 ? T.b.back() : 0.0) * before;
    T.a.push_back(w.dot(q));
    w -= T.a.back() * q;
    T.b.push_back(w.norm());
    if (T.b.back() < 1e-12) break;
    before = q;
    q = w / T.b.back();
  }
  return T;
}

VectorXd random_start(std::mt19937& generator, int n) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  VectorXd v(n);
  for (double& entry : v) entry = uniform(generator);
  return v;
}

/// As the body of a mesh has them: many, evenly spread, and one `gap` above them.
VectorXd spectrum(int n, double gap) {
  VectorXd eigenvalues = VectorXd::LinSpaced(n, 0.0, 1.0);
  eigenvalues[n - 1] = 1.0 + gap;
  return eigenvalues;
}

TEST(EigenvalueBound, HoldsUnlessTheStartHidesTheMode) {
  constexpr int n = 300;
  for (const double gap : {0.0, 0.02, 0.1, 1.0, 10.0}) {
    const VectorXd eigenvalues = spectrum(n, gap);
    std::mt19937 generator(1);
    for (int run = 0; run < 100; ++run) {
      VectorXd q = random_start(generator, n).normalized();
      q[n - 1] = std::pow(10.0, -run % 10);
      q.normalize();
      const Tridiagonal T = lanczos(eigenvalues, q, 1 + run % 19);
      EXPECT_GE(structure::eigenvalue_bound(T, q[n - 1]), eigenvalues[n - 1]);
    }
  }
}

// A start of which the mode has all, or all that the first product does not: nothing may be given away.
TEST(EigenvalueBound, IsReached) {
  EXPECT_NEAR(structure::eigenvalue_bound({{3.0}, {1e-14}}, 0.5), 3.0, 1e-8);
  // A = [1 2; 2 1], eigenvalue 3 of (1, 1) / sqrt(2), start (1, 0): one step sees a = 1, b = 2.
  EXPECT_NEAR(structure::eigenvalue_bound({{1.0}, {2.0}}, std::sqrt(0.5)), 3.0, 1e-8);
}

TEST(EigenvalueBound, OfAnExhaustedSpaceIsTheEigenvalue) {
  const VectorXd eigenvalues = (VectorXd(4) << 1.0, 2.0, 5.0, 7.0).finished();
  EXPECT_NEAR(structure::eigenvalue_bound(lanczos(eigenvalues, VectorXd::Ones(4), 10), 1e-3), 7.0, 1e-6);
}

TEST(EigenvalueBound, GetsLowerWithEveryStep) {
  std::mt19937 generator(3);
  const VectorXd start = random_start(generator, 300), eigenvalues = spectrum(300, 0.05);
  double before = 1e9;
  for (int steps = 1; steps < 30; ++steps) {
    const double bound = structure::eigenvalue_bound(lanczos(eigenvalues, start, steps), 1e-3);
    EXPECT_LT(bound, before);
    before = bound;
  }
}

// Of 4,000 starts, for modes that are one axis and modes that are spread over many.
TEST(HiddenShare, IsAsRareAsItIsSaidToBe) {
  constexpr int n = 100, runs = 4000;
  for (const double chance : {0.01, 0.1, 0.5})
    for (const int spread : {1, 2, n}) {
      VectorXd y = VectorXd::Zero(n);
      y.head(spread).setConstant(1.0 / std::sqrt(spread));
      std::mt19937 generator(7);
      int hidden = 0;
      for (int run = 0; run < runs; ++run) {
        const VectorXd v = random_start(generator, n);
        hidden += std::abs(v.dot(y)) / v.norm() <= structure::hidden_share(v.norm(), chance);
      }
      const double deviation = std::sqrt(chance * runs);
      EXPECT_LT(hidden, chance * runs + 3.0 * deviation) << chance << " " << spread;
      EXPECT_GT(hidden, 0.6 * chance * runs - 3.0 * deviation) << chance << " " << spread;
    }
}

}  // namespace
