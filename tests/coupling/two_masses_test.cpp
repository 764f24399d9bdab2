// SPDX-License-Identifier: GPL-2.0-or-later
// Sub-steps against the exact map of two masses, a spring on the ground and one between them, and what `auto`
// makes of it.
#include "coupling/two_masses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "coupling/substeps.h"
#include "one_mode.h"
#include "options_of_substeps.h"

namespace {

using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::SubstepOptions;
using coupling::Substeps;
using coupling::TwoMasses;
using nurbs::kPi;
using test::options;
using Fast = SubstepOptions::Fast;

/// `springs`: the part of its stiffness that is theirs.
Substeps one_mode(double omega, SubstepOptions options, double springs = 0.0) {
  structure::ExplicitSolver solver(std::make_unique<OneMode>(omega * std::sqrt(1.0 - springs)), {});
  std::vector<structure::Springs::Spring> ground;
  for (int A = 0; A < 4; ++A)
    ground.push_back({A, 0.25 * springs * omega * omega * structure::Stiffness3::Identity()});
  structure::Springs all;
  all.add(ground);
  solver.set_springs(std::move(all));
  return Substeps(std::make_unique<coupling::IgaStructure>(
                      std::move(solver), std::vector<structure::SkinPiece>{{0, nurbs::Face::zeta_plus}}),
                  std::move(options));
}

/// The particle on its spring, integrated as LIGGGHTS does, and the body.
struct Pair {
  TwoMasses problem;
  double dt;
  Substeps body;
  double x = 0.0, v = 0.0, F = 0.0;  // F: on the particle

  Pair(const TwoMasses& two, double step, SubstepOptions how, double springs = 0.0)
      : problem(two), dt(step), body(one_mode(two.mode, std::move(how), springs)) {
    body.set_time_step(dt);
  }
  double mass() const { return problem.mass_ratio; }
  double stiffness() const { return mass() * problem.contact * problem.contact; }
  NodalForces on_body() {
    F = -stiffness() * (x - body.positions()(2, 0));
    NodalVectors forces = NodalVectors::Zero(3, 4);
    forces.row(2).setConstant(-0.25 * F);
    return NodalForces(forces);
  }
  void start(const Eigen::Vector4d& state) {
    std::vector<double> saved(1 + 3 * 12, 0.0);
    for (int A = 0; A < 4; ++A) saved[1 + 3 * A + 2] = state[0], saved[1 + 12 + 3 * A + 2] = state[1];
    body.load(saved);
    x = state[2], v = state[3];
    body.initialise_forces(on_body());
  }
  void step() {
    v += 0.5 * dt * F / mass();
    x += dt * v;
    body.begin_step();
    const NodalForces forces = on_body();
    v += 0.5 * dt * F / mass();
    body.end_step(forces);
  }
  double energy() {
    const double gap = x - body.positions()(2, 0);
    return body.kinetic_energy() + body.strain_energy() + 0.5 * mass() * v * v +
           0.5 * stiffness() * gap * gap;
  }
};

TEST(TwoMasses, AreWhatSubstepsOfTheParticlesDo) {
  const TwoMasses problem{0.03, 0.04, 2.0};
  const int count = 5;
  Pair pair(problem, 1.0, options(Fast::particles, count));
  Eigen::Vector4d state(0.1, 0.02, 0.3, -0.2);
  pair.start(state);
  const Eigen::Matrix4d A = coupling::particle_substeps_matrix(problem, 1.0, count);
  for (int outer = 0; outer < 40; ++outer) {
    for (int n = 0; n < count; ++n) pair.step();
    state = A * state;
    EXPECT_NEAR(pair.body.positions()(2, 0), state[0], 1e-12);
    EXPECT_NEAR(pair.body.velocities()(2, 0), state[1], 1e-12);
    EXPECT_NEAR(pair.x, state[2], 1e-12);
    EXPECT_NEAR(pair.v, state[3], 1e-12);
  }
}

// Internal forces are impulses to a particle that swings on its spring: wherever it turns by k pi between
// two. From the eigenvector that grows most, v, the state after n outer steps is Re(lambda^n v).
TEST(TwoMasses, ThreeResonancesOfFastParticlesGrowAsTheMatrixSays) {
  const double dt = 1.0;
  const int count = 40;
  for (int k = 1; k <= 3; ++k) {
    TwoMasses problem{0.02, 0.0, 1.0};
    double worst = 0.0;
    for (double turn = 0.9; turn <= 1.01; turn += 0.002) {  // of the spring between the two, in an outer step
      problem.contact = 2.0 * std::sin(0.5 * turn * k * kPi / count) / std::sqrt(2.0);
      const Eigen::Matrix4d A = coupling::particle_substeps_matrix(problem, dt, count);
      const Eigen::EigenSolver<Eigen::Matrix4d> eigen(A);
      Eigen::Index most;
      const double grows = eigen.eigenvalues().cwiseAbs().maxCoeff(&most) - 1.0;
      EXPECT_NEAR(coupling::growth(A), grows, 1e-9);
      const Eigen::Vector4cd vector = eigen.eigenvectors().col(most);
      const int outer = grows > 1e-3 ? std::max(1, static_cast<int>(std::log(2.0) / grows)) : 100;
      Pair pair(problem, dt, options(Fast::particles, count));
      pair.start(vector.real());
      for (int n = 0; n < outer * count; ++n) pair.step();
      const std::complex<double> expected = std::pow(eigen.eigenvalues()[most], outer) * vector[2];
      EXPECT_NEAR(pair.x, expected.real(), 1e-7) << k << " " << turn;
      worst = std::max(worst, grows);
    }
    EXPECT_GT(worst, 1e-3) << "resonance " << k;
  }
}

// Contacts are impulses to a mode of the body.  Its growth is that of the mode which grows most, or decays
// least, seen after many steps.
TEST(TwoMasses, ThreeResonancesOfAFastStructureGrowAsTheMatrixSays) {
  const double dt = 1.0, lead = 2.0 * 0.02 / kPi * dt;  // damping of 2 % at the first resonance
  const int count = 12, steps = 3000;
  for (int k = 1; k <= 3; ++k)
    for (double turn = 0.98; turn <= 1.021; turn += 0.01) {
      const TwoMasses problem{turn * k * kPi / dt, 0.04, 20.0};
      const double grows = coupling::growth(coupling::structure_substeps_matrix(problem, dt, count, lead));
      Pair pair(problem, dt, options(Fast::structure, count));
      pair.start({0, 0, 0.3, -0.2});
      for (int n = 0; n < steps; ++n) pair.step();
      const double before = pair.energy();
      for (int n = 0; n < steps; ++n) pair.step();
      const double measured = 0.5 * std::log(pair.energy() / before) / steps;
      EXPECT_NEAR(measured, std::log1p(grows), 0.02 * std::abs(grows) + 1e-4) << k << " " << turn;
    }
}

// Near the resonances of contacts, springs between two masses, which turn by k pi in an outer step; bodies
// with stable steps of so many particle steps.
TEST(Substeps, AutoStaysBelowNarrowResonances) {
  for (const auto& [stable, ratio] :
       {std::pair{50.0, 30.0}, {150.0, 3.0}, {110.0, 0.01}, {100.0, 0.3}, {30.0, 100.0}, {75.0, 1.0}}) {
    Substeps body = one_mode(2.0 / stable, options(Fast::particles, {}, 0.25 * ratio));
    body.set_time_step(1.0);
    const int count = body.count();
    double worst = 0.0;
    for (double turn = 0.9; turn <= 2.05; turn += turn < 1.05 ? 0.001 : 0.01)  // of pi
      for (const double mode : {0.6, 0.8, 0.9, 0.96, 1.0}) {
        const double contact = 2.0 * std::sin(0.5 * turn * kPi / count) / std::sqrt(1.0 + ratio);
        if (contact > 4.03 / 100.0) continue;
        worst = std::max(worst, coupling::growth(coupling::particle_substeps_matrix(
                                    {2.0 / stable * mode, contact, ratio}, 1.0, count)));
      }
    EXPECT_LE(worst, 1e-6) << stable << ' ' << ratio << ": " << count;
  }
}

// What `auto` allows is looked at again on a finer grid than it looks on, with other numbers.
TEST(Substeps, AutoLetsNothingGrowAndTakesTheLargestNumberThatDoesNot) {
  for (const double ratio : {0.1, 1.0, 20.0}) {
    const double omega = 0.04;
    Substeps body = one_mode(omega, options(Fast::particles, {}, 0.25 * ratio));
    body.set_time_step(1.0);
    const TwoMasses highest{omega, 4.03 / 100.0, ratio};
    const auto worst = [&](int count) {
      double most = 0.0;
      for (int i = 1; i <= 61; ++i)
        for (int j = 1; j <= 97; ++j)
          most = std::max(most, coupling::growth(coupling::particle_substeps_matrix(
                                    {omega * i / 61, highest.contact * j / 97, ratio}, 1.0, count)));
      return most;
    };
    EXPECT_GT(body.count(), 1);
    EXPECT_LE(worst(body.count()), 1e-6) << ratio;
    const double resonance = kPi / (highest.contact * std::sqrt(1.0 + ratio));
    if (body.count() + 1 <= 0.95 * std::min(resonance, 2.0 / omega)) {
      EXPECT_GT(worst(body.count() + 1), 1e-6) << ratio;
    }
  }
}

constexpr double kLead = 2.0 * 0.02 / kPi;  // of particle steps of 1

/// Of modes up to `highest`, on a fine grid close to the resonances.
double worst_near_resonances(double highest, double ratio, int count, bool spread) {
  double worst = 0.0;
  for (int k = 1; k <= 3; ++k)
    for (double turn = -0.05; turn <= 0.05; turn += 0.0007)
      for (int j = 1; j <= 7; ++j) {  // by the angle of the body's own steps
        const double mode = 2.0 * count * std::sin(0.5 * (k + turn) * kPi / count);
        if (mode > highest || (k + turn) > count) continue;
        const TwoMasses problem{mode, 4.03 / 100.0 * j / 7, ratio};
        worst = std::max(
            worst, coupling::growth(coupling::structure_substeps_matrix(problem, 1.0, count, kLead, spread)));
      }
  return worst;
}

// Impulses of heavy particles are spread: beside 100 and 1000 times the mass nothing grows, up to the stable
// step, where damping alone lets it grow by 5e-4.
TEST(TwoMasses, SpreadImpulsesOfHeavyParticlesDoNotGrow) {
  for (const auto& [count, ratio] : {std::pair{3, 100.0}, {5, 1000.0}, {10, 1000.0}}) {
    const double highest = 2.0 * (std::hypot(1.0 / count, kLead) - kLead) * count * count;
    const TwoMasses two{highest, 4.03 / 100.0, ratio};
    EXPECT_LE(coupling::most_growth_of_structure_substeps(two, 1.0, count, kLead, true), 1e-6) << count;
    EXPECT_LE(worst_near_resonances(highest, ratio, count, true), 1e-6) << count;
    EXPECT_GT(coupling::most_growth_of_structure_substeps(two, 1.0, count, kLead, false), 1e-4) << count;
  }
}

TEST(TwoMasses, AreWhatSpreadImpulsesDo) {
  const int count = 4;
  for (const auto& [turn, springs] :
       {std::pair{0.3, 0.0}, {0.99, 0.0}, {1.6, 0.0}, {2.01, 0.0}, {0.99, 0.5}, {1.6, 1.0}}) {
    const TwoMasses problem{turn * kPi, 0.04, 100.0};
    // The body takes nodes of a quarter of its mass for the lightest.
    Pair pair(problem, 1.0, options(Fast::structure, count, 25.0), springs);
    const bool spread = pair.body.describe_step().find("spread") != std::string::npos;
    EXPECT_EQ(spread, turn > 1.0) << "growth between pi and 2 pi";
    pair.start({0.0, 0.0, 0.3, -0.2});
    const double k_over_m = problem.contact * problem.contact,
                 share = spread ? coupling::spread_share(problem.mode, 1.0 / count, count) : 1.0;
    // Velocities of half a step before, so that those after it are of half a kick; the damping sees them.
    const double damping = 1.0 - problem.mode * problem.mode * kLead / count;
    Eigen::Vector4d state(0.0, -0.5 * share * k_over_m * problem.mass_ratio * 0.3 / damping, 0.3,
                          -0.2 + 0.5 * k_over_m * 0.3);
    const Eigen::Matrix4d A = coupling::structure_substeps_matrix(problem, 1.0, count, kLead, spread);
    for (int n = 0; n < 200; ++n) {
      pair.step();
      state = A * state;
      ASSERT_NEAR(pair.body.positions()(2, 0), state[0], 1e-11) << turn << " " << n;
      ASSERT_NEAR(pair.x, state[2], 1e-11);
    }
  }
}

TEST(Substeps, AutoSpreadsImpulsesOfHeavyParticles) {
  Substeps light = one_mode(5.0, options(Fast::by_time_step, {}, 1e-5));
  light.set_time_step(1.0);
  EXPECT_FALSE(light.particles_fast());
  EXPECT_THAT(light.describe_step(), testing::HasSubstr("substeps structure 3"));
  EXPECT_THAT(light.describe_step(), testing::Not(testing::HasSubstr("spread")));
  Substeps heavy = one_mode(5.0, options(Fast::by_time_step, {}, 10.0));
  heavy.set_time_step(1.0);
  EXPECT_THAT(heavy.describe_step(), testing::HasSubstr("contacts are spread"));
  Substeps far_too_heavy = one_mode(5.0, options(Fast::by_time_step, {}, 1e4));
  try {
    far_too_heavy.set_time_step(1.0);
    FAIL();
  } catch (const std::invalid_argument& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("may make vibrations grow"));
  }
}

TEST(Substeps, WithoutAWordTheTimeStepSaysWhoIsFast) {
  Substeps body = one_mode(1.0, options(Fast::by_time_step, 4));
  body.set_time_step(0.2);
  EXPECT_TRUE(body.particles_fast());
  EXPECT_EQ(body.count(), 4);
  body.set_time_step(3.0);
  EXPECT_FALSE(body.particles_fast());
}

TEST(Substeps, AutoWithoutParticlesTakesNone) {
  Substeps body = one_mode(1.0, options(Fast::particles, {}));
  body.set_time_step(0.01);
  EXPECT_EQ(body.count(), 1);
}

TEST(Substeps, HoldTheRightStepAgainstTheStableOne) {
  const double stable = 2.0;  // of omega = 1
  Substeps particles = one_mode(1.0, options(Fast::particles, 5));
  particles.set_time_step(0.95 * stable / 5);
  EXPECT_THROW(particles.set_time_step(1.01 * stable / 5), std::invalid_argument);
  Substeps structure = one_mode(1.0, options(Fast::structure, 5));
  structure.set_time_step(0.85 * 5 * stable);
  EXPECT_THROW(structure.set_time_step(0.97 * 5 * stable), std::invalid_argument) << "damping takes some";
}

}  // namespace
