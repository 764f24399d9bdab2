// SPDX-License-Identifier: GPL-2.0-or-later
// Sub-steps against the exact map of two masses, a spring on the ground and one between them; momentum, work
// and saved states of a solid.
#include "coupling/substeps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "coupling/force_distribution.h"
#include "coupling/two_masses.h"
#include "nurbs/primitives.h"
#include "one_mode.h"
#include "structure/conditions/loads.h"
#include "structure/material/laws.h"
#include "structure/material/saint_venant_kirchhoff.h"
#include "structure/solid/solid.h"

namespace {

using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::SubstepOptions;
using coupling::Substeps;
using coupling::TwoMasses;
using coupling::Vector3;
using Fast = SubstepOptions::Fast;

constexpr double kPi = 3.14159265358979323846;

SubstepOptions options(Fast fast, std::optional<int> count, double heaviest = 0.0) {
  return {fast, count, [=] { return heaviest; }};
}

Substeps one_mode(double omega, SubstepOptions options) {
  return Substeps(std::make_unique<coupling::IgaStructure>(
                      structure::ExplicitSolver(std::make_unique<OneMode>(omega), {}),
                      std::vector<structure::SkinPiece>{{0, nurbs::Face::zeta_plus}}),
                  std::move(options));
}

/// The particle on its spring, integrated as LIGGGHTS does, and the body.
struct Pair {
  TwoMasses problem;
  double dt;
  Substeps body;
  double x = 0.0, v = 0.0, F = 0.0;  // F: on the particle

  Pair(const TwoMasses& two, double step, SubstepOptions how)
      : problem(two), dt(step), body(one_mode(two.mode, std::move(how))) {
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
    if ((body.count() + 1) * 1.0 <= 0.95 * 2.0 / omega) {
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
  for (const double turn : {0.3, 0.99, 1.6, 2.01}) {
    const TwoMasses problem{turn * kPi, 0.04, 100.0};
    // The body takes nodes of a quarter of its mass for the lightest.
    Pair pair(problem, 1.0, options(Fast::structure, count, 25.0));
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

/// A block of 3 x 3 x 2 elements, free or on a fixed ground.
std::unique_ptr<coupling::IgaStructure> block(bool fixed = false,
                                              std::shared_ptr<const structure::Material> material = {}) {
  const auto knots = [](int n) { return nurbs::KnotVector::uniform(2, n); };
  nurbs::Volume patch = nurbs::box({0, 0, -2}, {3, 3, 2}, {knots(3), knots(3), knots(2)});
  structure::Supports supports;
  if (fixed) {
    supports.fix(structure::nodes_on(patch.space, {nurbs::Face::zeta_minus}), {true, true, true});
    supports.fix(structure::nodes_on(patch.space, {nurbs::Face::xi_minus}), {false, false, true});
  }
  if (!material) material = std::make_shared<structure::LinearElastic>(1.0, 0.3, 1.0);
  structure::ExplicitSolver solver(std::make_unique<structure::Solid>(std::move(patch), material), supports);
  solver.set_load(structure::gravity_load(solver.body(), {1e-4, 0, -2e-4}));
  return std::make_unique<coupling::IgaStructure>(
      std::move(solver), std::vector<structure::SkinPiece>{{0, nurbs::Face::zeta_plus}});
}

NodalVectors on_surface(const coupling::StructureSolver& body, const NodalVectors& nodal) {
  NodalVectors values;
  body.surface().map.to_surface(nodal, values);
  return values;
}

/// A force that follows the surface and drags at it, so that it depends on places and velocities.
NodalForces forces_on(const coupling::StructureSolver& body) {
  const auto& topology = body.surface().topology;
  const NodalVectors x = on_surface(body, body.positions()), v = on_surface(body, body.velocities());
  NodalVectors spread = NodalVectors::Zero(3, topology.control_point_count());
  const coupling::FootBasis foot(topology, {0, {0.3, 0.7}});
  Vector3 at = Vector3::Zero(), speed = Vector3::Zero();
  for (int k = 0; k < spread.cols(); ++k) {
    NodalVectors unit = NodalVectors::Zero(3, spread.cols());
    foot.distribute(Vector3(1, 0, 0), unit);
    at += unit(0, k) * x.col(k), speed += unit(0, k) * v.col(k);
  }
  foot.distribute(Vector3(1e-3, 0, -5e-3) - 0.05 * (at - Vector3(0.9, 2.1, 0)) - 0.01 * speed, spread);
  NodalVectors forces = NodalVectors::Zero(3, body.positions().cols());
  body.surface().map.add_to_nodes(spread, forces);
  return NodalForces(forces);
}

void run(Substeps& body, int steps) {
  for (int n = 0; n < steps; ++n) {
    body.begin_step();
    body.end_step(forces_on(body));
  }
}

struct Way {
  Fast fast;
  double step;
  double heaviest;  // of heavy particles the impulses are spread
};

class BothWays : public testing::TestWithParam<Way> {
 protected:
  double step() const { return GetParam().step; }
  SubstepOptions how(int count) const { return options(GetParam().fast, count, GetParam().heaviest); }
};
INSTANTIATE_TEST_SUITE_P(Substeps, BothWays,
                         testing::Values(Way{Fast::particles, 0.02, 0.0}, Way{Fast::structure, 1.0, 0.0},
                                         Way{Fast::structure, 1.8, 0.3}));

TEST_P(BothWays, AreWhatTheyAreSaidToBe) {
  Substeps body(block(true), how(5));
  body.set_time_step(step());
  EXPECT_EQ(body.describe_step().find("spread") != std::string::npos, GetParam().heaviest > 0.0);
}

TEST_P(BothWays, ASingleStepIsThePlainOne) {
  Substeps body(block(true), how(1));
  const std::unique_ptr<coupling::IgaStructure> plain = block(true);
  const double dt = 0.02;
  body.set_time_step(dt), plain->set_time_step(dt);
  body.initialise_forces(forces_on(body)), plain->initialise_forces(forces_on(*plain));
  for (int n = 0; n < 50; ++n) {
    body.begin_step(), plain->begin_step();
    const NodalForces forces = forces_on(*plain);
    body.end_step(forces), plain->end_step(forces);
  }
  EXPECT_LT((on_surface(body, body.positions()) - on_surface(*plain, plain->positions())).norm(), 1e-13);
  EXPECT_LT((on_surface(body, body.velocities()) - on_surface(*plain, plain->velocities())).norm(), 1e-13);
  EXPECT_NEAR(body.kinetic_energy(), plain->kinetic_energy(), 1e-12 * plain->kinetic_energy());
}

TEST_P(BothWays, KeepMomentumToRoundOff) {
  Substeps body(block(), how(5));
  body.set_time_step(step());
  NodalForces forces = forces_on(body);
  body.initialise_forces(forces);
  Vector3 impulse = Vector3::Zero();
  const int steps = 40;
  for (int n = 0; n < steps; ++n) {
    impulse += 0.5 * step() * forces.values.rowwise().sum();
    body.begin_step();
    forces = forces_on(body);
    impulse += 0.5 * step() * forces.values.rowwise().sum();
    body.end_step(forces);
  }
  impulse += 18.0 * steps * step() * Vector3(1e-4, 0, -2e-4);
  EXPECT_LT((body.linear_momentum() - impulse).norm(), 1e-13 * impulse.norm() * steps);
}

// Work of contacts by the rule of the step: the mean velocity of each half kick.
TEST_P(BothWays, TheirLedgerIsClosedAndKnowsTheWorkOfContacts) {
  std::unique_ptr<coupling::IgaStructure> solid = block(true);
  const NodalVectors inverse_mass = solid->solver().inverse_mass();
  Substeps body(std::move(solid), how(5));
  body.set_time_step(step());
  const bool inner = GetParam().fast == Fast::particles;
  NodalForces forces = forces_on(body);
  body.initialise_forces(forces);
  const double start = body.kinetic_energy();
  double contacts = 0.0;
  for (int n = 0; n < 200; ++n) {
    const NodalVectors kick = 0.5 * step() * forces.values.cwiseProduct(inverse_mass);
    if (inner) {  // velocities at once before and after; within an outer step theirs have the outer half kick
      body.begin_step();
      contacts += 0.5 * step() * forces.values.cwiseProduct(body.velocities() - 0.5 * kick).sum();
      forces = forces_on(body);
      const NodalVectors second = 0.5 * step() * forces.values.cwiseProduct(inverse_mass);
      contacts += 0.5 * step() * forces.values.cwiseProduct(body.velocities() + 0.5 * second).sum();
      body.end_step(forces);
    } else {
      run(body, 1);
    }
    const coupling::Work work = body.work();
    const double turned_over = std::abs(work.contacts) + std::abs(work.internal) + std::abs(work.loads);
    EXPECT_NEAR(body.kinetic_energy() + work.internal - work.loads - work.contacts, start,
                1e-12 * turned_over);
    if (inner && n % 5 == 4) {
      EXPECT_NEAR(work.contacts, contacts, 1e-12 * turned_over);
    }
  }
}

TEST_P(BothWays, ContinueFromASavedStateToTheLastBit) {
  for (const int before : {10, 13}) {  // at the end of an outer step, and within one
    Substeps first(block(true), how(5)), second(block(true), how(5));
    first.set_time_step(step()), second.set_time_step(step());
    first.initialise_forces(forces_on(first));
    run(first, before);
    second.load(first.save());
    second.set_time_step(step());
    for (Substeps* body : {&first, &second}) {
      body->initialise_forces(forces_on(*body));
      run(*body, 19);
    }
    EXPECT_TRUE(on_surface(first, first.positions()) == on_surface(second, second.positions()));
    EXPECT_TRUE(on_surface(first, first.velocities()) == on_surface(second, second.velocities()));
    EXPECT_TRUE(first.save() == second.save());
    EXPECT_EQ(first.work().contacts, second.work().contacts);
  }
}

TEST(Substeps, ARunThatIsSplitWithinAnOuterStepGoesOnAsTheWholeDoes) {
  Substeps whole(block(true), options(Fast::particles, 5)), split(block(true), options(Fast::particles, 5));
  for (Substeps* body : {&whole, &split}) {
    body->set_time_step(0.02);
    body->initialise_forces(forces_on(*body));
    run(*body, 13);
  }
  split.set_time_step(0.02);
  EXPECT_THROW(split.set_time_step(0.01), std::invalid_argument);
  split.initialise_forces(forces_on(split));
  run(whole, 12), run(split, 12);
  const NodalVectors v = on_surface(whole, whole.velocities());
  EXPECT_LT((on_surface(split, split.velocities()) - v).norm(), 1e-3 * v.norm());
  split.set_time_step(0.01);  // now an outer step is done
}

TEST(Substeps, WithinAnOuterStepTheBodysNumbersAreThoseOfItsBeginning) {
  Substeps body(block(true), options(Fast::particles, 5));
  body.set_time_step(0.02);
  body.initialise_forces(forces_on(body));
  run(body, 5);
  const double kinetic = body.kinetic_energy(), strain = body.strain_energy(), work = body.work().contacts;
  run(body, 4);
  EXPECT_EQ(body.kinetic_energy(), kinetic);
  EXPECT_EQ(body.strain_energy(), strain);
  EXPECT_EQ(body.work().contacts, work);
  run(body, 1);
  EXPECT_NE(body.kinetic_energy(), kinetic);
}

/// A block whose lower face stays while the rest flies off, of a law that stiffens.
std::unique_ptr<coupling::IgaStructure> stretched_block(double speed) {
  auto body = block(true, std::make_shared<structure::SaintVenantKirchhoff>(1.0, 0.3, 1.0));
  NodalVectors v = NodalVectors::Zero(3, body->positions().cols());
  v.row(2).setConstant(speed);
  body->solver().set_velocities(v);
  return body;
}

struct Changes {
  std::vector<std::string> said;
  std::vector<int> counts;
};

Changes run_and_listen(Substeps& body, int steps) {
  Changes changes;
  for (int n = 0; n < steps; ++n) {
    run(body, 1);
    if (std::string change = body.take_change(); !change.empty()) {
      changes.said.push_back(std::move(change));
      changes.counts.push_back(body.count());
    }
  }
  EXPECT_EQ(body.take_change(), "");
  return changes;
}

void expect_closed_ledger(const Substeps& body, double start) {
  const coupling::Work work = body.work();
  EXPECT_NEAR(body.kinetic_energy() + work.internal - work.loads - work.contacts, start, 1e-12 * start);
}

// Strain shortens the stable step: fewer particle steps in one of the body's, then more steps of the body in
// one of theirs.
TEST(Substeps, AutoTakesAnotherNumberWhereStrainAsksForIt) {
  const double stable = stretched_block(0.3)->stable_time_step();
  for (const bool by_time_step : {true, false}) {
    Substeps body(stretched_block(0.3),
                  options(by_time_step ? Fast::by_time_step : Fast::particles, {}, 1e-4));
    body.set_time_step(0.32 * stable);
    EXPECT_EQ(body.count(), 3);
    body.initialise_forces(forces_on(body));
    const double start = body.kinetic_energy();
    const Changes changes = run_and_listen(body, 30);
    ASSERT_EQ(changes.said.size(), 1u);
    EXPECT_THAT(changes.said[0], testing::HasSubstr("substeps particles 2"));
    EXPECT_THAT(changes.said[0], testing::HasSubstr("brought its stable step down to"));
    expect_closed_ledger(body, start);
  }
  for (const Fast fast : {Fast::by_time_step, Fast::structure}) {
    Substeps body(stretched_block(0.3), options(fast, {}, 1e-4));
    body.set_time_step(0.97 * stable);
    EXPECT_EQ(body.count(), 1);
    body.initialise_forces(forces_on(body));
    const double start = body.kinetic_energy();
    const Changes changes = run_and_listen(body, 20);
    ASSERT_EQ(changes.said.size(), 1u);
    EXPECT_THAT(changes.said[0], testing::HasSubstr("substeps structure 2"));
    expect_closed_ledger(body, start);
  }
}

TEST(Substeps, ANumberStaysAndSaysWhatHelps) {
  const double stable = stretched_block(0.3)->stable_time_step();
  const auto failure = [&](Fast fast, std::optional<int> count, double dt) -> std::string {
    Substeps body(stretched_block(0.3), options(fast, count, 1e-4));
    try {
      body.set_time_step(dt);
      body.initialise_forces(forces_on(body));
      run(body, 60);
    } catch (const std::exception& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_THAT(failure(Fast::particles, 3, 0.32 * stable), testing::HasSubstr("or 'substeps auto'"));
  EXPECT_THAT(failure(Fast::structure, 1, 0.97 * stable), testing::HasSubstr("or 'substeps auto'"));
  EXPECT_THAT(failure(Fast::particles, {}, 0.97 * stable),
              testing::AllOf(testing::HasSubstr("above the structure's stable step"),
                             testing::HasSubstr("or 'substeps auto'")));
}

}  // namespace
