// SPDX-License-Identifier: GPL-2.0-or-later
// A spring along the surface of a mesh that gives way at once: it is stretched by what the particle moves
// over the body beyond the dent.
#include "coupling/contact/shear_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

#include "nurbs/types.h"

namespace {

using contact::ShearBlock;
using contact::ShearKernel;
using nurbs::SimdLevel;
using nurbs::Vector3;

constexpr double kShearStiffness = 50.0, kStep = 1e-3;
const ShearKernel kShearKernel = contact::shear_kernel(nurbs::simd_level());

void put(const Vector3& v, ShearBlock::Lanes* lanes, int lane) {
  for (int d = 0; d < 3; ++d) lanes[d][lane] = v[d];
}
Vector3 get(const ShearBlock::Lanes* lanes, int lane) {
  return {lanes[0][lane], lanes[1][lane], lanes[2][lane]};
}

/// A contact on the plane z = 0, whose S_j are 2 e_x and 4 e_y, in one of the lanes.
class SpringContact {
 public:
  /// c and its changes with both parameters are those of components 11, 22, 12.
  explicit SpringContact(double scale = 1.0) {
    put({0, 0, 1}, block.normal, kLane);
    put({2, 0, 0}, block.first, kLane);
    soften(scale);
    const double changes[3][2] = {{1e-3, -2e-3}, {3e-3, 5e-4}, {-4e-4, 7e-4}}, rates[2] = {0.25, 0.0625};
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < 2; ++j) block.gradient[c][j][kLane] = rates[j] * changes[c][j];
    block.inertia[kLane] = 1.0, block.normal_stiffness[kLane] = kShearStiffness;
    set_stiffness(kShearStiffness);
  }
  void soften(double scale) {
    const double c[3] = {4e-3, 6e-3, -1e-3};
    for (int i = 0; i < 3; ++i) block.give[i][kLane] = scale * c[i];
  }
  void set_stiffness(double k) { block.stiffness[kLane] = k; }
  void begin(const Vector3& slip, const Vector3& own, const Vector3& stretch) {
    put(slip, block.slip, kLane);
    put(own - slip, block.wall, kLane);
    put(stretch, block.stretch, kLane);
    kShearKernel.begin(block, kStep);
    rate = slip + get(block.more_rate, kLane);
    more = get(block.more, kLane);
  }
  void end(const Vector3& stretch) {
    put(stretch, block.stretch, kLane);
    kShearKernel.end(block);
  }
  static constexpr int kLane = 5;
  ShearBlock block;
  Vector3 rate, more;  // of a step
};

Eigen::Matrix2d matrix(double first, double second, double both) {
  Eigen::Matrix2d c;
  c << first, both, both, second;
  return c;
}
Vector3 in_space(const Eigen::Vector2d& v) { return {v[0], v[1], 0.0}; }

// Stiffness and compliance change on the way, as overlaps and feet do; no slip.
TEST(ShearCompliance, SpringsAreStretchedByTheMotionBeyondTheDent) {
  SpringContact contact;
  Eigen::Vector2d stretch(0, 0), path(0, 0), dent(0, 0), dent_before(0, 0);
  for (int k = 0; k < 3000; ++k) {
    const double t = k * kStep, stiffness = kShearStiffness * (0.2 + 0.2 * t),
                 scale = 1.0 + 0.1 * std::sin(3.0 * t);
    const Eigen::Vector2d own(std::cos(2.0 * t), 0.3 - t);
    const Eigen::Vector2d of_foot = (dent - dent_before) / kStep;
    contact.soften(scale);
    contact.set_stiffness(stiffness);
    contact.begin(in_space(own - of_foot), in_space(own), in_space(stretch));
    stretch += (kStep * contact.rate + contact.more).head<2>();
    contact.end(in_space(stretch));
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
  SpringContact contact(1e-6);
  contact.block.normal_dashpot[SpringContact::kLane] = 2.0;
  const Eigen::Vector2d own(0.5, 0.0), body(0.2, 0.1);
  Vector3 stretch = Vector3::Zero();
  for (int k = 0; k < 4000; ++k) {
    const double shake = k == 0 ? 0.0 : k % 2 == 0 ? 3.0 : -3.0;
    const Eigen::Vector2d slip = own - (k < 20 ? Eigen::Vector2d(0, 0) : body) - Eigen::Vector2d(shake, 0);
    contact.begin(in_space(slip), in_space(own), stretch);
    if (k < 20) {
      EXPECT_NEAR((contact.rate - in_space(own)).norm(), 0.0, 0.2) << k;
    }
    stretch += kStep * contact.rate + contact.more;
    contact.end(stretch);
  }
  EXPECT_NEAR((contact.rate - in_space(own - body)).norm(), 0.0, 0.2);
}

TEST(ShearCompliance, TheForceAlongIsThatOfThePotential) {
  SpringContact contact;
  contact.begin({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  const Eigen::Vector2d stretch(0.03, -0.02), F = kShearStiffness * stretch;
  contact.end(in_space(stretch));
  const double by_xi = 0.5 * F.dot(matrix(1e-3, 3e-3, -4e-4) * F),
               by_eta = 0.5 * F.dot(matrix(-2e-3, 5e-4, 7e-4) * F);
  EXPECT_NEAR(contact.block.along[0][SpringContact::kLane], -0.25 * by_xi, 1e-15);
  EXPECT_NEAR(contact.block.along[1][SpringContact::kLane], -0.0625 * by_eta, 1e-15);
}

// Dampers of both directions have the same share of critical damping.
TEST(ShearCompliance, KnowsItsLargestShare) {
  SpringContact contact;
  contact.block.normal_stiffness[SpringContact::kLane] = 4.0 * kShearStiffness;
  contact.block.normal_dashpot[SpringContact::kLane] = 3.0;
  contact.begin({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  EXPECT_NEAR(contact.block.share[SpringContact::kLane], kShearStiffness * (5e-3 + std::sqrt(2.0) * 1e-3),
              1e-12);
  EXPECT_NEAR(contact.block.dashpot[SpringContact::kLane], 1.5, 1e-14);
}

// Where Coulomb's limit has cut the stretch the dent is as deep as that, and the body as fast as the foot.
TEST(ShearCompliance, WhereItSlipsTheDentStays) {
  SpringContact contact;
  contact.begin({1, 0, 0}, {1, 0, 0}, {0.02, 0, 0});
  contact.end({0.02, 0, 0});
  const Vector3 dent = get(contact.block.memory, SpringContact::kLane),
                body = get(contact.block.memory + 3, SpringContact::kLane);
  EXPECT_NEAR((dent - kShearStiffness * 0.02 * Vector3(4e-3, -1e-3, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(body.norm(), 0.0);
}

TEST(ShearKernel, AllInstructionSetsFindTheSameDigits) {
  std::mt19937 engine(5);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto fill = [&](ShearBlock::Lanes& lanes, double low, double high) {
    for (double& lane : lanes) lane = in(low, high);
  };
  for (int trial = 0; trial < 200; ++trial) {
    ShearBlock block;
    for (int k = 0; k < ShearBlock::kCapacity; ++k)
      put(Vector3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized(), block.normal, k);
    for (auto* vectors : {block.first, block.slip, block.wall, block.stretch, block.memory, block.memory + 3})
      for (int d = 0; d < 3; ++d) fill(vectors[d], -1.0, 1.0);
    for (int c = 0; c < 3; ++c) {
      fill(block.give[c], 0.01, 0.02);
      for (auto& along : block.gradient[c]) fill(along, -1.0, 1.0);
    }
    for (auto* positive : {&block.stiffness, &block.normal_stiffness, &block.normal_dashpot, &block.inertia})
      fill(*positive, 1.0, 5.0);
    const auto run = [&](SimdLevel level, const ShearBlock& from) {
      ShearBlock on = from;
      const ShearKernel kernel = contact::shear_kernel(level);
      kernel.begin(on, kStep);
      kernel.end(on);
      return on;
    };
    const ShearBlock expected = run(SimdLevel::portable, block);
    for (const SimdLevel level : {SimdLevel::avx2, SimdLevel::avx512}) {
      if (!nurbs::available(level)) continue;
      const ShearBlock found = run(level, block);
      for (int k = 0; k < ShearBlock::kCapacity; ++k) {
        ASSERT_EQ(found.share[k], expected.share[k]);
        ASSERT_EQ(get(found.more_rate, k), get(expected.more_rate, k));
        ASSERT_EQ(get(found.more, k), get(expected.more, k));
        for (int m = 0; m < ShearBlock::kMemory; ++m) ASSERT_EQ(found.memory[m][k], expected.memory[m][k]);
        for (int j = 0; j < 2; ++j) ASSERT_EQ(found.along[j][k], expected.along[j][k]);
      }
    }
  }
}

}  // namespace
