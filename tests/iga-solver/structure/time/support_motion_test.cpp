// SPDX-License-Identifier: GPL-2.0-or-later
// Supports that move: where they are, the work that they do, and a state that is saved on the way.
#include "structure/time/support_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::ExplicitSolver;
using structure::NodeSet;
using structure::TimeMass;

constexpr double kStep = 0.05;

nurbs::Volume block() { return models::block({2, 1, 1}, {4, 2, 2}, 2); }

NodeSet moved_nodes() { return structure::nodes_on(block().space, {Face::xi_plus}); }

/// Held on the left, moved on the right in x and z.
ExplicitSolver solver(structure::TimeFunction time, TimeMass mass) {
  structure::Supports supports;
  supports.fix(structure::nodes_on(block().space, {Face::xi_minus}), {true, true, true});
  supports.move(moved_nodes(), {true, false, true}, {0.02, 5.0, -0.01}, std::move(time));
  ExplicitSolver solver(std::make_unique<structure::Solid>(block(), models::large_strain_laws().front(),
                                                           structure::Integration{{}, {}, mass}),
                        supports);
  solver.set_time_step(kStep);
  return solver;
}

NodalVectors no_forces() { return NodalVectors::Zero(3, block().space.control_point_count()); }

void unloaded_step(ExplicitSolver& solver) {
  solver.begin_step();
  solver.end_step(no_forces());
}

class SupportMotion : public testing::TestWithParam<TimeMass> {};
INSTANTIATE_TEST_SUITE_P(Masses, SupportMotion, testing::Values(TimeMass::lumped, TimeMass::corrected),
                         [](const auto& of) { return std::string(name(of.param)); });

TEST_P(SupportMotion, IsAtTheGivenPlacesWithTheVelocitiesAndAccelerationsOfTheScheme) {
  const structure::TimeFunction sine = structure::sine(0.3, 0.4);
  ExplicitSolver body = solver(sine, GetParam());
  body.initialise_forces(no_forces());
  const int node = moved_nodes()[3];
  const auto given = [&](int n) { return Vector3(Vector3(0.02, 0, -0.01) * sine(n * kStep)); };
  EXPECT_LT((body.displacements().col(node) - given(0)).norm(), 1e-17);
  for (int n = 1; n < 40; ++n) {
    unloaded_step(body);
    for (int i : {0, 2}) {
      EXPECT_NEAR(body.displacements()(i, node), given(n)[i], 1e-16);
      const double next = given(n + 1)[i], now = given(n)[i], last = given(n - 1)[i];
      EXPECT_NEAR(body.velocities()(i, node), (next - last) / (2 * kStep), 1e-14);
      EXPECT_NEAR(body.accelerations()(i, node), (next - 2 * now + last) / (kStep * kStep), 1e-12);
    }
  }
  EXPECT_GT(std::abs(body.displacements()(1, node)), 1e-6) << "free across";
}

// Of any motion, also one that begins with a jump of the velocity, and whose table has kinks.
TEST_P(SupportMotion, DoesTheWorkThatTheBodyGets) {
  ExplicitSolver body = solver(structure::table({{0, 0}, {0.33, 1}, {0.9, -0.5}, {1.2, 0.5}}), GetParam());
  body.set_mass_damping(0.8);
  body.initialise_forces(no_forces());
  double kinetic = body.kinetic_energy(), most = 0.0;
  structure::Work before = body.work();
  for (int n = 0; n < 60; ++n) {
    unloaded_step(body);
    const structure::Work now = body.work();
    const double change = body.kinetic_energy() - kinetic;
    most = std::max(most, body.kinetic_energy());
    EXPECT_NEAR(
        change,
        now.supports - before.supports - (now.internal - before.internal) - (now.damped - before.damped),
        1e-12 * most);
    kinetic += change;
    before = now;
  }
  EXPECT_GT(std::abs(before.supports), 0.1 * most);
  EXPECT_NEAR(body.truncation(body.strain_energy()), 0.0, 0.05 * before.supports);
}

TEST_P(SupportMotion, ReactionsAreTheChangeOfMomentum) {
  ExplicitSolver body = solver(structure::ramp(0.2, 1.0), GetParam());
  body.keep_reactions();
  const structure::NamedSupport all{"all", body.fixed_dofs()};
  body.initialise_forces(no_forces());
  Vector3 momentum = body.linear_momentum(), force = body.reaction(all);
  for (int n = 0; n < 60; ++n) {
    unloaded_step(body);
    const Vector3 next = body.reaction(all), expected = 0.5 * kStep * (force + next);
    EXPECT_LT((body.linear_momentum() - momentum - expected).norm(), 1e-15);
    momentum = body.linear_momentum();
    force = next;
  }
}

TEST_P(SupportMotion, GoesOnFromASavedStateToTheLastBit) {
  const structure::TimeFunction ramp = structure::ramp(0.2, 2.2);
  ExplicitSolver one = solver(ramp, GetParam()), other = solver(ramp, GetParam());
  one.initialise_forces(no_forces());
  for (int n = 0; n < 17; ++n) unloaded_step(one);
  other.load(one.save());
  other.initialise_forces(no_forces());
  for (int n = 0; n < 17; ++n) unloaded_step(one), unloaded_step(other);
  EXPECT_EQ(one.save(), other.save());
  EXPECT_GT(one.displacements().col(moved_nodes()[0])[0], 0.0);
}

// A shaken face that the next model only holds.
TEST_P(SupportMotion, AStateThatMovesIsStoppedWhereTheBodyIsFixed) {
  ExplicitSolver shaken = solver(structure::sine(0.3, 0.4), GetParam());
  shaken.initialise_forces(no_forces());
  for (int n = 0; n < 5; ++n) unloaded_step(shaken);
  ASSERT_GT(std::abs(shaken.velocities()(0, moved_nodes()[3])), 1e-3);
  structure::Supports fixed;
  for (const Face face : {Face::xi_minus, Face::xi_plus})
    fixed.fix(structure::nodes_on(block().space, {face}), {true, true, true});
  ExplicitSolver held(std::make_unique<structure::Solid>(block(), models::large_strain_laws().front(),
                                                         structure::Integration{{}, {}, GetParam()}),
                      fixed);
  held.set_mass_damping(0.1);
  held.set_time_step(kStep);
  held.load(shaken.save());
  held.initialise_forces(no_forces());
  const double start = held.kinetic_energy();
  for (int n = 0; n < 20; ++n) unloaded_step(held);
  for (const int node : moved_nodes())
    EXPECT_EQ(Vector3(held.displacements().col(node)), Vector3(shaken.displacements().col(node)));
  const structure::Work work = held.work();
  EXPECT_NEAR(held.kinetic_energy() + work.internal + work.damped, start, 1e-13 * start);
}

TEST(Supports, KeepWhatHeldANodeFirst) {
  structure::Supports supports;
  supports.fix({1}, {true, false, false});
  supports.move({1, 2}, {true, true, false}, {1, 2, 3}, {});
  supports.fix({2}, {true, true, true});
  ASSERT_EQ(supports.motions().size(), 1u);
  EXPECT_EQ(supports.motions()[0].dofs, (std::vector<Eigen::Index>{4, 6, 7}));
  EXPECT_EQ(supports.motions()[0].size, (std::vector<double>{2, 1, 2}));
  const structure::Supports part = supports.on({2, -1, 1});
  EXPECT_EQ(part.motions()[0].dofs, (std::vector<Eigen::Index>{0, 1, 7}));
  EXPECT_EQ(part.motions()[0].size, (std::vector<double>{1, 2, 2}));
  EXPECT_EQ(part.fixed_dofs(), (std::vector<Eigen::Index>{0, 1, 2, 6, 7}));
}

}  // namespace
