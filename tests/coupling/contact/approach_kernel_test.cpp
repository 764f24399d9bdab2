// SPDX-License-Identifier: GPL-2.0-or-later
// The overlap that is left behind a compliance; and a ball on a spring with a mass, which stands for a mesh
// that gives way, as damped contacts are corrected by it: the same as the ball on a rigid wall, whose law is
// integrated here by itself.
#include "coupling/contact/approach_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "coupling/contact/compliance.h"
#include "nurbs/types.h"

namespace {

using contact::ApproachBlock;
using contact::ApproachKernel;
using nurbs::kPi;
using nurbs::SimdLevel;

const ApproachKernel kApproachKernel = contact::approach_kernel(nurbs::simd_level());
constexpr double kLimit = 0.9;

/// Overlaps in all lanes behind c of a law K.
ApproachBlock solved(double K, double c, const std::vector<double>& overlaps, double limit = kLimit) {
  ApproachBlock block;
  for (int k = 0; k < ApproachBlock::kCapacity; ++k) {
    block.overlap[k] = overlaps[k % overlaps.size()];
    block.constant[k] = K, block.radius[k] = 1.0, block.give[k] = c;
  }
  kApproachKernel.elastic(block, {limit, 1.0, 1.0});
  return block;
}

constexpr double kStiff = 7e3;

TEST(ApproachKernel, SolvesForTheLawsOwnOverlap) {
  const std::vector<double> overlaps = {1e-12, 1e-4, 3e-2};
  for (const double c : {3e-4, 1e-5, 0.0, -1e-5, -3e-3, -1.0}) {
    const ApproachBlock block = solved(kStiff, c, overlaps);
    for (int k = 0; k < ApproachBlock::kCapacity; ++k) {
      const double x = block.x[k], overlap = block.overlap[k];
      EXPECT_NEAR(x - c * kStiff * x * std::sqrt(x), overlap, 1e-15 + 1e-13 * overlap) << c;
      EXPECT_NEAR(block.root[k], std::sqrt(x), 1e-14 * block.root[k]);
      EXPECT_NEAR(block.force[k], kStiff * std::pow(x, 1.5), 1e-13 * block.force[k]);
      const double s = 1.5 * c * kStiff * std::sqrt(x);
      EXPECT_NEAR(block.give_way[k], s, 1e-9 * (1.0 + std::abs(s)));
    }
  }
}

// x (1 - 2 s/3) has its largest value where s = 1: nothing beyond that has a solution, and nothing beyond the
// limit is looked for.
TEST(ApproachKernel, StopsAtTheLimit) {
  const double c = 3e-4, at_limit = std::pow(kLimit / (1.5 * c * kStiff), 2),
               overlap = at_limit * (1.0 - 2.0 / 3.0 * kLimit);
  const ApproachBlock block = solved(kStiff, c, {0.999 * overlap, 1.001 * overlap, 100.0 * overlap});
  EXPECT_LT(block.give_way[0], kLimit);
  EXPECT_NEAR(block.give_way[0], kLimit, 0.01);
  EXPECT_GE(block.give_way[1], kLimit);
  EXPECT_NEAR(block.give_way[2], 10.0 * kLimit, 1e-9);  // elements 10 times as large would be at the limit
}

constexpr double kHertz = 1.0, kMass = 1.0;
constexpr double kSpeed = 0.9;  // the ball goes in by about 1 where nothing is damped

/// Of a coefficient of restitution.
double damping_of(double e) {
  const double zeta = -std::log(e) / std::hypot(std::log(e), kPi);
  return 2.0 * zeta * std::sqrt(5.0 / 6.0 * 1.5 * kHertz * kMass);
}

struct Answer {
  double restitution, peak;
};

constexpr double kStands = 1e99;

/// Of a rigid body of a mass.
Answer rigid(double e, double dt, double mass = kStands) {
  const double both = 1.0 / (1.0 / kMass + 1.0 / mass);
  double x = 0.0, v = kSpeed, F = 0.0, peak = 0.0;
  do {
    v -= 0.5 * dt * F / both;
    x += dt * v;
    F = x > 0.0 ? kHertz * x * std::sqrt(x) + damping_of(e) * std::sqrt(std::sqrt(x)) * v : 0.0;
    v -= 0.5 * dt * F / both;
    peak = std::max(peak, F);
  } while (x > 0.0);
  return {-v / kSpeed, peak};
}

/// What contact does in a step (compliance.cpp), in one of the lanes.
class DampedContact {
 public:
  DampedContact(double e, double c, double delay, double credit = kStands) {
    block_.constant[kLane] = kHertz, block_.radius[kLane] = 1.0, block_.give[kLane] = c;
    block_.damping[kLane] = damping_of(e), block_.inertia[kLane] = kMass, block_.delay[kLane] = delay;
    block_.credit[kLane] = credit;
  }
  double step(double overlap, double of_particle, double of_surface, double dt) {
    if (overlap <= -contact::ComplianceCorrection::held_gap(x())) {
      for (int m = 0; m < ApproachBlock::kMemory; ++m) number(m) = 0.0;
      return 0.0;
    }
    block_.overlap[kLane] = overlap;
    block_.of_particle[kLane] = of_particle, block_.of_surface[kLane] = of_surface;
    kApproachKernel.damped(block_, {0.99, dt, dt});
    return block_.x[kLane] > 0.0 ? block_.force[kLane] : 0.0;
  }
  double x() const { return block_.memory[ApproachBlock::kX][kLane]; }

 private:
  static constexpr int kLane = 3;
  double& number(int m) { return block_.memory[m][kLane]; }
  ApproachBlock block_;
};

/// Ball and mesh; all speeds are towards the body, which itself comes at `body`.
struct BallAndMesh {
  BallAndMesh(double e, double s, double body, double dt, double mass = kStands, double spring_mass = 3e-4)
      : c(s / 1.5 / kHertz),
        spring_mass(spring_mass),
        contact(e, c, std::sqrt(spring_mass * c)),
        body(body),
        dt(dt),
        mass(mass) {}
  void step(double pressed = 0.0) {
    constexpr double kLoss = 0.3;
    ball += 0.5 * dt * (pressed - F) / kMass;
    const double spring = dent / c + 2.0 * kLoss * std::sqrt(spring_mass / c) * dent_speed;
    dent_speed += dt * (F - spring) / spring_mass;
    body -= dt * spring / mass;
    dent += dt * dent_speed;
    const double towards = body - mobility * spring;
    x += dt * (ball + towards);
    F = contact.step(x - dent, ball, towards - dent_speed, dt);
    ball += 0.5 * dt * (pressed - F) / kMass;
  }
  double c, spring_mass;  // which give way in (c spring_mass)^(1/2)
  DampedContact contact;
  double body, dt, mass, mobility = 0.0, ball = 0.0, x = 0.0, dent = 0.0, dent_speed = 0.0, F = 0.0;
};

constexpr double kFineStep = 4e-4;

TEST(DampedApproach, ABallLeavesAsFastAsARigidWall) {
  for (const double e : {0.1, 0.3, 0.5, 0.7, 0.95})
    for (const double s : {0.1, 0.3, 0.5}) {
      BallAndMesh scene(e, s, 0.0, kFineStep);
      scene.ball = kSpeed;
      double peak = 0.0;
      while (scene.x > -0.3) {
        scene.step();
        peak = std::max(peak, scene.F);
        ASSERT_LT(peak, 2.0) << e << " " << s << " x " << scene.x;
      }
      const Answer expected = rigid(e, kFineStep);
      EXPECT_NEAR(-scene.ball / kSpeed / expected.restitution, 1.0, 0.01) << e << ' ' << s;
      EXPECT_NEAR(peak / expected.peak, 1.0, 0.01) << e << ' ' << s;
    }
}

// A thirtieth of the duration of a contact.
TEST(DampedApproach, AMeshThatTakesItsTimeIsWaitedFor) {
  for (const double e : {0.3, 0.5, 0.8}) {
    constexpr double kSpringMass = 0.04;
    BallAndMesh scene(e, 0.3, 0.0, kFineStep, kStands, kSpringMass);
    scene.ball = kSpeed;
    double peak = 0.0;
    while (scene.x > -0.3 && scene.ball > -kSpeed) {
      scene.step();
      peak = std::max(peak, scene.F);
    }
    const Answer expected = rigid(e, kFineStep);
    EXPECT_NEAR(-scene.ball / kSpeed / expected.restitution, 1.0, 0.03) << e;
    EXPECT_NEAR(peak / expected.peak, 1.0, 0.03) << e;
  }
}

// A twentieth, where damping is strong: without the delay in the observer the force rings, and is 3 % too
// high.
TEST(DampedApproach, AMeshThatIsLateDoesNotMakeTheForceRing) {
  BallAndMesh scene(0.1, 0.1, 0.0, kFineStep, kStands, 0.3);
  scene.ball = kSpeed;
  double peak = 0.0;
  while (scene.x > -0.3 && scene.ball > -kSpeed) {
    scene.step();
    peak = std::max(peak, scene.F);
  }
  EXPECT_NEAR(peak / rigid(0.1, kFineStep).peak, 1.0, 0.01);
}

TEST(DampedApproach, ItIsTheSameIfTheBodyComesToTheBall) {
  BallAndMesh scene(0.5, 0.3, kSpeed, kFineStep);
  while (scene.x > -0.3) scene.step();
  EXPECT_NEAR(-(scene.ball + kSpeed) / kSpeed, rigid(0.5, kFineStep).restitution, 0.005);
}

/// Of a thin plate, which moves as fast as `mobility` times the force on it (C. Zener, Phys. Rev. 59, 1941).
Answer on_plate(double e, double mobility, double dt) {
  double x = 0.0, v = kSpeed, F = 0.0, peak = 0.0;
  do {
    v -= 0.5 * dt * F / kMass;
    x += dt * (v - mobility * F);
    const double gamma = damping_of(e) * std::sqrt(std::sqrt(std::max(x, 0.0)));
    F = x > 0.0 ? (kHertz * x * std::sqrt(x) + gamma * v) / (1.0 + gamma * mobility) : 0.0;
    v -= 0.5 * dt * F / kMass;
    peak = std::max(peak, F);
  } while (x > 0.0);
  return {-v / kSpeed, peak};
}

TEST(DampedApproach, AThinPlateTakesMuchOfTheSpeed) {
  for (const double mobility : {0.1, 0.2})
    for (const double e : {0.5, 0.8})
      for (const double s : {0.05, 0.2}) {
        BallAndMesh scene(e, s, 0.0, kFineStep);
        scene.ball = kSpeed;
        scene.mobility = mobility;
        double peak = 0.0;
        while (scene.x > -0.3 && scene.ball > -kSpeed) {
          scene.step();
          peak = std::max(peak, scene.F);
        }
        const Answer expected = on_plate(e, mobility, kFineStep);
        EXPECT_LT(expected.restitution, 0.9 * rigid(e, kFineStep).restitution);
        EXPECT_NEAR(-scene.ball / kSpeed / expected.restitution, 1.0, 0.01) << e << ' ' << s;
        EXPECT_NEAR(peak / expected.peak, 1.0, 0.025) << e << ' ' << s;
      }
}

// Nobody tells it how the body moves beyond the dent.
TEST(DampedApproach, ABodyIsPushedAway) {
  for (const double e : {0.5, 0.9}) {
    constexpr double kBody = 4.0;
    BallAndMesh scene(e, 0.2, 0.0, kFineStep, kBody);
    scene.ball = kSpeed;
    while (scene.x > -0.3) scene.step();
    EXPECT_NEAR(-(scene.ball + scene.body) / kSpeed / rigid(e, kFineStep, kBody).restitution, 1.0, 0.03) << e;
  }
}

TEST(DampedApproach, UnderAWeightItComesToTheLawsOwnOverlap) {
  constexpr double kWeight = 0.4;
  for (const double e : {0.3, 0.7}) {
    BallAndMesh scene(e, 0.4, 0.0, kFineStep);
    for (int k = 0; k < 400000; ++k) scene.step(kWeight);
    const double x = std::pow(kWeight / kHertz, 2.0 / 3.0);
    EXPECT_NEAR(scene.F, kWeight, 1e-6 * kWeight);
    EXPECT_NEAR(scene.contact.x(), x, 1e-6);
    EXPECT_NEAR(scene.x, x, 1e-6);
  }
}

// A ball that lies on a body which vibrates must take energy from it, at any frequency: here the body is
// moved, a little and not so little faster than the ball's own vibration on its contact, and what the contact
// has done to it in many periods is counted.
TEST(DampedApproach, AVibratingBodyLosesEnergyAtAnyFrequency) {
  constexpr double kWeight = 0.4, kAmplitude = 1e-4, kGive = 0.05;
  const double x = std::pow(kWeight / kHertz, 2.0 / 3.0),
               own = std::sqrt(1.5 * std::sqrt(x) * kHertz / kMass);
  for (const double e : {0.3, 0.5, 0.7, 0.9})
    for (const double ratio : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
      DampedContact contact(e, kGive, 0.01);
      const double frequency = ratio * own, dt = std::min(kFineStep, 0.02 / frequency);
      const int steps = static_cast<int>(40.0 * 2.0 * kPi / own / dt);
      double ball = 0.0, place = x, F = kWeight, taken = 0.0;
      for (int k = 0; k < steps; ++k) {
        const double phase = frequency * k * dt, speed = kAmplitude * frequency * std::cos(phase);
        ball += 0.5 * dt * (kWeight - F) / kMass;
        place += dt * ball;
        F = contact.step(place + kAmplitude * std::sin(phase) - kGive * F, ball, speed, dt);
        ball += 0.5 * dt * (kWeight - F) / kMass;
        if (2 * k > steps) taken += dt * (F - kWeight) * speed;  // the beginning is another matter
      }
      EXPECT_GT(taken, 0.0) << e << ' ' << ratio;
    }
}

// A body that goes away faster than anybody can know, and comes back, gets no energy that it has not given,
// but for the half kicks that are under way when it goes.
TEST(DampedApproach, GivesNoMoreThanItHasTaken) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> in(0.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    const double e = 0.2 + 0.7 * in(engine), give = 0.3 * in(engine), ball = 0.5 * in(engine);
    const double frequency = std::exp(1.0 + 4.0 * in(engine)), size = 0.3 * in(engine);
    DampedContact contact(e, give, 0.02, 0.0);
    double taken = 0.0, before = 0.0, F_before = 0.0, under_way = 0.0;
    for (int k = 1; k < 20000; ++k) {
      const double phase = frequency * k * kFineStep, wave = size * std::sin(phase),
                   overlap = 0.2 * std::sin(0.5 * ball * k * kFineStep) - wave;
      const double F = contact.step(overlap, ball, (overlap - before) / kFineStep - ball, kFineStep);
      taken += 0.5 * (F_before + F) * (overlap - before);
      if (F == 0.0) under_way += 0.5 * std::abs(F_before * (overlap - before));
      before = overlap, F_before = F;
      ASSERT_GE(taken, -1.001 * under_way) << trial << ' ' << k;
    }
  }
}

// The skin that a ball comes to may vibrate, and be gone as they touch.  It comes back.
TEST(DampedApproach, AContactThatIsOverBeginsAnewWhereTheOverlapGrows) {
  DampedContact contact(0.3, 0.05, 0.01);
  constexpr double kSlow = 0.02, kAway = -0.5;
  EXPECT_GT(contact.step(1e-6, kSlow, kAway, kFineStep), -1.0);
  EXPECT_EQ(contact.step(0.5e-6, kSlow, kAway, kFineStep), 0.0);
  EXPECT_EQ(contact.step(0.4e-6, kSlow, kAway, kFineStep), 0.0);
  double overlap = 0.4e-6, F = 0.0;
  for (int k = 0; k < 100; ++k) F = contact.step(overlap += kFineStep * kSlow, kSlow, 0.0, kFineStep);
  EXPECT_GT(F, kHertz * overlap * std::sqrt(overlap));
}

// The dent of the beginning is deeper than the bodies have come together.
TEST(DampedApproach, ItGoesOnWhereSurfacesLoseTouch) {
  BallAndMesh scene(0.3, 0.3, 0.0, kFineStep);
  scene.ball = kSpeed;
  double deepest_gap = 0.0, least = 1.0;
  while (scene.x < 0.2) {
    scene.step();
    if (scene.x > 2e-3) least = std::min(least, scene.F);
    deepest_gap = std::max(deepest_gap, scene.dent - scene.x);
  }
  EXPECT_GT(deepest_gap, 0.01);
  EXPECT_GT(least, 0.1);
}

// It finds what the contact was left with; what it keeps is not for a setup to change.
TEST(DampedApproach, ASetupMovesNothing) {
  ApproachBlock block;
  block.constant[0] = block.radius[0] = block.damping[0] = block.inertia[0] = 1.0;
  block.overlap[0] = 0.25, block.of_particle[0] = 1.0, block.of_surface[0] = 7.0;
  block.memory[ApproachBlock::kX][0] = 0.25, block.memory[ApproachBlock::kU][0] = 0.125;
  kApproachKernel.damped(block, {kLimit, 1e-3, 0.0});
  EXPECT_EQ(block.x[0], 0.25);
  EXPECT_NEAR(block.rate[0], 1.125, 1e-15);
  EXPECT_EQ(block.memory[ApproachBlock::kU][0], 0.125);
}

/// As contacts are, and as they end.
ApproachBlock random_block(std::mt19937& engine) {
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  ApproachBlock block;
  for (int k = 0; k < ApproachBlock::kCapacity; ++k) {
    block.overlap[k] = in(-0.1, 1.0);
    block.of_particle[k] = in(-1.0, 1.0), block.of_surface[k] = in(-1.0, 1.0);
    block.radius[k] = in(0.5, 2.0), block.constant[k] = in(0.5, 2.0), block.give[k] = in(-0.3, 0.3);
    block.damping[k] = in(0.1, 1.0), block.inertia[k] = in(0.5, 2.0), block.delay[k] = in(0.0, 0.1);
    for (auto& number : block.memory) number[k] = in(-1.0, 1.0);
    block.memory[ApproachBlock::kX][k] = in(-0.3, 1.0), block.credit[k] = in(0.0, 0.1);
  }
  return block;
}

TEST(ApproachKernel, AllInstructionSetsFindTheSameDigits) {
  std::mt19937 engine(5);
  for (int trial = 0; trial < 200; ++trial) {
    const ApproachBlock block = random_block(engine);
    for (const bool is_damped : {false, true}) {
      const auto run = [&](SimdLevel level, const ApproachBlock& from) {
        ApproachBlock on = from;
        const ApproachKernel kernel = contact::approach_kernel(level);
        (is_damped ? kernel.damped : kernel.elastic)(on, {kLimit, 0.01, 0.01});
        return on;
      };
      const ApproachBlock expected = run(SimdLevel::portable, block);
      for (const SimdLevel level : {SimdLevel::avx2, SimdLevel::avx512}) {
        if (!nurbs::available(level)) continue;
        const ApproachBlock found = run(level, block);
        const auto same = [&](const ApproachBlock::Lanes& a, const ApproachBlock::Lanes& b) {
          for (int k = 0; k < ApproachBlock::kCapacity; ++k)
            if (is_damped ? expected.x[k] > 0.0 : block.overlap[k] > 0.0) {
              ASSERT_EQ(a[k], b[k]) << k;
            }
        };
        same(found.x, expected.x), same(found.rate, expected.rate), same(found.force, expected.force);
        same(found.give_way, expected.give_way), same(found.tangent, expected.tangent);
        for (int m = 0; m < ApproachBlock::kMemory; ++m) same(found.memory[m], expected.memory[m]);
      }
    }
  }
}

}  // namespace
