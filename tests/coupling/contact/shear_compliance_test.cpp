// SPDX-License-Identifier: GPL-2.0-or-later
// A spring along the surface of a mesh that gives way at once: it is stretched by what the particle moves
// over the body beyond the dent.
#include "coupling/contact/shear_compliance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using contact::ShearCompliance;
using contact::SurfaceDirections;
using coupling::LocalCompliance;
using nurbs::Vector3;

constexpr double kShearStiffness = 50.0, kStep = 1e-3;
const SurfaceDirections kDirections = {Eigen::Matrix<double, 3, 2>{{2, 0}, {0, 4}, {0, 0}},
                                       Eigen::Matrix2d{{0.25, 0}, {0, 0.0625}}};
const Vector3 kNormal = {0, 0, 1};

/// Components 11, 22, 12 and their changes with both parameters.
LocalCompliance::Value give(double scale = 1.0) {
  LocalCompliance::Value value{};
  value.along = {LocalCompliance::Component{4e-3 * scale, {1e-3, -2e-3}},
                 LocalCompliance::Component{6e-3 * scale, {3e-3, 5e-4}},
                 LocalCompliance::Component{-1e-3 * scale, {-4e-4, 7e-4}}};
  return value;
}
Eigen::Matrix2d matrix(double first, double second, double both) {
  Eigen::Matrix2d c;
  c << first, both, both, second;
  return c;
}
Vector3 in_space(const Eigen::Vector2d& v) { return {v[0], v[1], 0.0}; }

// Stiffness and compliance change on the way, as overlaps and feet do; no slip.
TEST(ShearCompliance, SpringsAreStretchedByTheMotionBeyondTheDent) {
  double memory[ShearCompliance::kMemory] = {};
  Eigen::Vector2d stretch(0, 0), path(0, 0), dent(0, 0), dent_before(0, 0);
  for (int k = 0; k < 3000; ++k) {
    const double t = k * kStep, stiffness = kShearStiffness * (0.2 + 0.2 * t),
                 scale = 1.0 + 0.1 * std::sin(3.0 * t);
    const Eigen::Vector2d own(std::cos(2.0 * t), 0.3 - t);
    const Eigen::Vector2d of_foot = (dent - dent_before) / kStep;
    ShearCompliance shear(give(scale), kDirections, kNormal, stiffness);
    const ShearCompliance::Step step =
        shear.begin({in_space(own - of_foot), in_space(own), in_space(stretch), 0.0, 1.0, kStep}, memory);
    stretch += (kStep * step.rate + step.more).head<2>();
    shear.end(in_space(stretch), memory);
    dent_before = dent;
    dent = stiffness * matrix(4e-3, 6e-3, -1e-3) * scale * stretch;
    path += kStep * own;
    // the foot is one step late here
    ASSERT_LT((stretch - path).norm(), 3.0 * (dent - dent_before).norm() + 1e-12) << k;
  }
  EXPECT_GT(dent.norm(), 0.01 * path.norm());
}

// A damper takes the particle's own speed, and the body's beyond the dent when that is known.
TEST(ShearCompliance, DampersDoNotSeeWhatTheFootDoesAtOnce) {
  double memory[ShearCompliance::kMemory] = {};
  const Eigen::Vector2d own(0.5, 0.0), body(0.2, 0.1);
  Vector3 stretch = Vector3::Zero(), damped = Vector3::Zero();
  for (int k = 0; k < 4000; ++k) {
    const double shake = k == 0 ? 0.0 : k % 2 == 0 ? 3.0 : -3.0;
    const Eigen::Vector2d slip = own - (k < 20 ? Eigen::Vector2d(0, 0) : body) - Eigen::Vector2d(shake, 0);
    ShearCompliance shear(give(1e-6), kDirections, kNormal, kShearStiffness);
    const ShearCompliance::Step step =
        shear.begin({in_space(slip), in_space(own), stretch, 2.0, 1.0, kStep}, memory);
    if (k < 20) {
      EXPECT_NEAR((step.rate - in_space(own)).norm(), 0.0, 0.2) << k;
    }
    stretch += kStep * step.rate + step.more;
    shear.end(stretch, memory);
    damped = step.rate;
  }
  EXPECT_NEAR((damped - in_space(own - body)).norm(), 0.0, 0.2);
}

TEST(ShearCompliance, TheForceAlongIsThatOfThePotential) {
  const ShearCompliance shear(give(), kDirections, kNormal, kShearStiffness);
  const Eigen::Vector2d stretch(0.03, -0.02), F = kShearStiffness * stretch;
  const double by_xi = 0.5 * F.dot(matrix(1e-3, 3e-3, -4e-4) * F),
               by_eta = 0.5 * F.dot(matrix(-2e-3, 5e-4, 7e-4) * F);
  const Vector3 expected(-0.5 * by_xi, -0.25 * by_eta, 0.0);
  EXPECT_LT((kDirections.tangents * shear.force_along(in_space(stretch)) - expected).norm(), 1e-15);
}

TEST(ShearCompliance, KnowsItsLargestShare) {
  const ShearCompliance shear(give(), kDirections, kNormal, kShearStiffness);
  const double share = kShearStiffness * (5e-3 + std::sqrt(2.0) * 1e-3);
  EXPECT_NEAR(shear.largest_share(), share, 1e-12);
  EXPECT_NEAR(shear.stiffness(), kShearStiffness / (1.0 - share), 1e-9);
}

}  // namespace
