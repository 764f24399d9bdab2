// SPDX-License-Identifier: GPL-2.0-or-later
// A modal body beside the whole solid that it was made from, and beside closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/force_distribution.h"
#include "coupling/modal_structure.h"
#include "modal_bar.h"
#include "point_force.h"
#include "structure/conditions/loads.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"

namespace {

using coupling::IgaStructure;
using coupling::ModalStructure;
using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::Vector3;
using structure::ExplicitSolver;
using test::bar;
using test::clamped;
using test::held_end;
using test::kDensity;
using test::kLength;
using test::kTop;
using test::modal;
using test::unit_block;
using test::whole;

/// A pulse that lasts so long.
double pulse(double t, double duration) {
  return t < duration ? std::pow(std::sin(3.14159265358979 * t / duration), 2) : 0.0;
}

double end_displacement(const coupling::StructureSolver& solver) {
  return solver.probes().front().displacement[2];
}

/// Displacements of the end at 20 times, under a pulse on the surface.
std::vector<double> response(coupling::StructureSolver& solver, double end, int steps, double duration) {
  const Vector3 F(0.1, 0.05, -0.4);
  const double dt = end / steps;
  solver.set_time_step(dt);
  solver.initialise_forces(point_force(solver, {0.8, 0.5}, F * pulse(0.0, duration)));
  std::vector<double> seen;
  for (int n = 1; n <= steps; ++n) {
    solver.begin_step();
    solver.end_step(point_force(solver, {0.8, 0.5}, F * pulse(n * dt, duration)));
    if (n % (steps / 20) == 0) seen.push_back(end_displacement(solver));
  }
  return seen;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  return difference / largest;
}

constexpr double kEnd = 20.0, kPulse = 4.0;

TEST(ModalStructure, OfManyModesMovesAsTheWholeSolid) {
  const auto solid = whole(bar());
  const std::vector<double> exact = response(*solid, kEnd, 20000, kPulse);
  const auto many = modal(whole(bar()), 134), few = modal(whole(bar()), 12);
  EXPECT_LT(largest_difference(response(*many, kEnd, 20000, kPulse), exact), 1e-5);
  EXPECT_LT(largest_difference(response(*few, kEnd, 2000, kPulse), exact), 5e-3);
  EXPECT_GT(largest_difference(response(*few, kEnd, 2000, kPulse), exact), 1e-5) << "some are left out";
}

TEST(ModalStructure, TakesStepsFarAboveTheStableOne) {
  const auto solid = whole(bar());
  const double stable = solid->stable_time_step();
  const std::vector<double> exact = response(*solid, kEnd, 20000, kPulse);
  const auto body = modal(whole(bar()), 12);
  const int steps = 60;
  EXPECT_GT(kEnd / steps, 4.0 * stable);
  EXPECT_LT(largest_difference(response(*body, kEnd, steps, kPulse), exact), 0.02);
  EXPECT_THAT(body->describe_step(), testing::HasSubstr("are slowed"));
  const auto none_slowed = modal(whole(bar()), 2);
  none_slowed->set_time_step(kEnd / steps);
  EXPECT_THAT(none_slowed->describe_step(), testing::Not(testing::HasSubstr("slowed")));
}

// A mass on a spring at the end of the bar, at a step in which the mode all but turns by pi: kicks on it as
// it is would make it grow by 1.5e-3 per step.
TEST(ModalStructure, DoesNotResonateWithContacts) {
  const auto body = modal(whole(bar()), 2);  // across and up, of one frequency
  const double omega = std::sqrt(structure::modal_basis(bar(), 1).eigenvalues[0]), dt = 3.04 / omega;
  const double mass = 20.0, stiffness = mass * std::pow(0.3 / dt, 2);
  const nurbs::Parameter<2> end{1.0, 0.5};
  const auto force = [&](double z) { return stiffness * (z - end_displacement(*body)); };
  body->set_time_step(dt);
  double z = 0.1, v = 0.0, largest = 0.0;
  body->initialise_forces(point_force(*body, end, {0, 0, force(z)}));
  for (int n = 0; n < 2000; ++n) {
    v -= 0.5 * dt * force(z) / mass;
    z += dt * v;
    body->begin_step();
    const double F = force(z);
    v -= 0.5 * dt * F / mass;
    body->end_step(point_force(*body, end, {0, 0, F}));
    largest = std::max(largest, std::abs(z));
  }
  EXPECT_LT(largest, 0.12);
}

// Contacts are kicks that know them at the ends of steps alone.
TEST(ModalStructure, IsOfSecondOrderInTheTimeOfContacts) {
  const auto error = [](int steps) {
    static const std::vector<double> exact = response(*modal(whole(bar()), 6), kEnd, 40000, kPulse);
    return largest_difference(response(*modal(whole(bar()), 6), kEnd, steps, kPulse), exact);
  };
  EXPECT_NEAR(std::log2(error(400) / error(800)), 2.0, 0.3);
}

struct Ledger {
  double kinetic, strain, contacts, loads, supports, damped;
  explicit Ledger(const coupling::StructureSolver& solver)
      : kinetic(solver.kinetic_energy()),
        strain(solver.work().internal),
        contacts(solver.work().contacts),
        loads(solver.work().loads),
        supports(solver.work().supports),
        damped(solver.work().damped) {}
  double balance() const { return kinetic + strain + damped - contacts - loads - supports; }
};

/// From rest.
structure::Supports shaken() {
  structure::Supports supports;
  supports.move(held_end(), {true, true, true}, {0.02, 0.0, 0.1},
                [](double t) { return 1.0 - std::cos(0.44 * t); });
  return supports;
}

/// All that there is: support that moves, damping of each kind, loads that change, contacts.
TEST(ModalStructure, LedgerIsClosedAndItsEnergiesAreTheSolids) {
  const structure::Supports supports = shaken();
  for (const bool damped : {false, true}) {
    ExplicitSolver solver = bar(supports);
    const NodalVectors weight = structure::gravity_load(solver.body(), {0.0, 0.01, -0.02});
    solver.set_load(weight);
    solver.add_load(std::make_unique<structure::FactoredLoad>(weight, structure::sine(0.05)));
    const auto body =
        modal(whole(std::move(solver)), 10,
              damped ? coupling::ModalDamping{{0.02, 0.01}, 0.03, 0.002} : coupling::ModalDamping{});
    const double dt = 0.05;
    body->set_time_step(dt);
    body->initialise_forces(point_force(*body, {0.8, 0.5}, {0, 0, 0}));
    const double start = Ledger(*body).balance();
    double turned_over = 0.0;
    for (int n = 1; n <= 400; ++n) {
      body->begin_step();
      body->end_step(point_force(*body, {0.8, 0.5}, Vector3(0, 0.1, -0.2) * pulse(n * dt, kPulse)));
      const Ledger now(*body);
      turned_over = std::max({turned_over, now.kinetic, std::abs(now.contacts), std::abs(now.supports)});
      ASSERT_NEAR(now.balance(), start, 1e-12 * turned_over + 1e-15) << "step " << n;
    }
    const Ledger end(*body);
    EXPECT_GT(std::abs(end.contacts), 1e-4);
    EXPECT_GT(std::abs(end.loads), 1e-4);
    EXPECT_GT(std::abs(end.supports), 1e-4);
    EXPECT_EQ(end.damped > 1e-4, damped);
    EXPECT_EQ(end.damped == 0.0, !damped);
    body->angular_momentum(Vector3::Zero());  // places all nodes
    const auto state = body->save();
    const auto nodes = whole(bar(supports));
    nodes->load({state.begin(), state.begin() + static_cast<long>(nodes->state_size())});
    EXPECT_NEAR(nodes->kinetic_energy(), end.kinetic, 1e-9 * end.kinetic);
    EXPECT_NEAR(nodes->strain_energy(), body->strain_energy(), 1e-9 * body->strain_energy());
    EXPECT_LT((nodes->linear_momentum() - body->linear_momentum()).norm(), 1e-10);
  }
}

TEST(ModalStructure, AMovingSupportShakesItAsItShakesTheWholeSolid) {
  const structure::Supports supports = shaken();
  const auto body = modal(whole(bar(supports)), 10);
  const auto solid = whole(bar(supports));
  const std::vector<double> found = response(*body, kEnd, 400, kPulse),
                            exact = response(*solid, kEnd, 20000, kPulse);
  EXPECT_LT(largest_difference(found, exact), 3e-3);
}

/// Fixed degrees of freedom of the held end, or its springs.
structure::NamedSupport watched(std::optional<std::size_t> springs = {}) {
  structure::NamedSupport support{"end", {}, springs};
  if (!springs)
    for (const Eigen::Index A : held_end())
      for (int i = 0; i < 3; ++i) support.dofs.push_back(3 * A + i);
  return support;
}

std::unique_ptr<IgaStructure> on_springs() {
  ExplicitSolver solver = bar({});
  std::vector<structure::Springs::Spring> springs;
  for (const Eigen::Index A : held_end())
    springs.push_back({A, structure::Stiffness3(Eigen::Vector3d(3.0, 4.0, 5.0).asDiagonal())});
  structure::Springs all;
  all.add(springs);
  solver.set_springs(std::move(all));
  auto body = whole(std::move(solver));
  body->watch({watched(0)});
  return body;
}

std::unique_ptr<IgaStructure> on_shaken_end() {
  auto body = whole(bar(shaken()));
  body->watch({watched()});
  return body;
}

TEST(ModalStructure, ReactionsAreThoseOfTheWholeSolid) {
  for (const auto make : {on_springs, on_shaken_end}) {
    const auto solid = make();
    const auto body = modal(make(), make == on_springs ? 160 : 134);
    const double end = 6.0;
    response(*solid, end, 4000, kPulse);
    response(*body, end, 4000, kPulse);
    const Vector3 expected = solid->reactions().front().force;
    EXPECT_GT(expected.norm(), 0.02);
    EXPECT_LT((body->reactions().front().force - expected).norm(), 2e-3 * expected.norm());
    EXPECT_NEAR(body->strain_energy(), solid->strain_energy(), 2e-3 * solid->strain_energy());
  }
}

// What is carried along from the start is not strained, however far it goes, and takes no force.
TEST(ModalStructure, AFarWayWithItsSupportsIsNeitherStrainNorWork) {
  structure::Supports supports;
  supports.move(held_end(), {true, true, true}, {0.0, 0.0, 1e4}, structure::ramp(0.0, 1e4));
  const auto begun = [&](double velocity) {
    ExplicitSolver solver = bar(supports);
    solver.set_velocities(Vector3(0, 0, velocity).replicate(1, solver.body().node_count()));
    auto solid = whole(std::move(solver));
    solid->watch({watched()});
    return modal(std::move(solid), 10);
  };
  const double mass = kDensity * kLength;
  for (const double v : {0.0, 0.5, 1.0}) EXPECT_NEAR(begun(v)->kinetic_energy(), mass * v * v / 2, 1e-10);
  const auto body = begun(1.0);
  body->set_time_step(0.5);
  const NodalForces none(NodalVectors::Zero(3, body->positions().cols()));
  body->initialise_forces(none);
  EXPECT_LT(body->reactions().front().force.norm(), 1e-9);
  const double start = body->kinetic_energy();  // with the mass of modes that are slowed
  for (int n = 0; n < 4000; ++n) {
    body->begin_step();
    body->end_step(none);
  }
  EXPECT_NEAR(end_displacement(*body), 2000.0, 1e-6);
  EXPECT_LT(body->strain_energy(), 1e-12);
  EXPECT_NEAR(body->kinetic_energy(), start, 1e-9);
  EXPECT_LT(std::abs(body->work().supports), 1e-9);
}

TEST(ModalStructure, ConstantAndLinearLoadsAreExactWhateverTheStep) {
  ExplicitSolver solver = bar();
  const NodalVectors pull = structure::gravity_load(solver.body(), {0.0, 0.0, -0.05});
  const double dead = 1.0, slope = 0.1;
  const auto loaded = [&] {
    ExplicitSolver body = bar();
    body.set_load(dead * pull);
    body.add_load(std::make_unique<structure::FactoredLoad>(pull, [=](double t) { return slope * t; }));
    return modal(whole(std::move(body)), 1);
  };
  const auto coarse = loaded(), fine = loaded();
  const auto run = [](ModalStructure& body, int steps) {
    body.set_time_step(6.0 / steps);
    const NodalForces none(NodalVectors::Zero(3, body.positions().cols()));
    body.initialise_forces(none);
    for (int n = 0; n < steps; ++n) {
      body.begin_step();
      body.end_step(none);
    }
    return end_displacement(body);
  };
  const double found = run(*coarse, 6), expected = run(*fine, 600);
  EXPECT_GT(std::abs(expected), 1e-3);
  EXPECT_NEAR(found, expected, 1e-11 * std::abs(expected));
}

TEST(ModalStructure, MomentumOfAFreeBodyIsForceTimesTime) {
  const structure::Supports none;
  const auto body = modal(whole(bar(none)), 12);
  const Vector3 F(0.3, 0.2, -0.5);
  body->set_time_step(0.1);
  const NodalForces forces = point_force(*body, {0.5, 0.5}, F);
  body->initialise_forces(forces);
  for (int n = 0; n < 50; ++n) {
    body->begin_step();
    body->end_step(forces);
  }
  EXPECT_LE((body->linear_momentum() - 5.0 * F).norm(), 1e-9 * F.norm());
}

TEST(ModalStructure, WarnsOfElementsThatTurn) {
  for (const double g : {0.001, 1.0}) {
    ExplicitSolver solver = bar();
    solver.set_load(structure::gravity_load(solver.body(), {0.0, 0.0, -g}));
    const auto body = modal(whole(std::move(solver)), 4);
    body->set_time_step(0.01);
    const NodalForces none(NodalVectors::Zero(3, body->positions().cols()));
    body->initialise_forces(none);
    for (int n = 0; n < structure::ElementWatch::kTurns; ++n) {
      body->begin_step();
      body->end_step(none);
    }
    EXPECT_EQ(body->take_warning().empty(), g < 0.5);
  }
}

TEST(ModalStructure, DampsAModeByItsRatio) {
  const double ratio = 0.05;
  const auto body = modal(whole(bar()), 1, {{ratio}, 0.0, 0.0});
  body->set_time_step(0.01);
  const NodalForces push = point_force(*body, {0.8, 0.5}, {0, 0, -100});
  const NodalForces none(NodalVectors::Zero(3, body->positions().cols()));
  body->initialise_forces(push);
  body->begin_step();
  body->end_step(none);
  const double start = body->kinetic_energy() + body->strain_energy();
  const double omega = std::sqrt(structure::modal_basis(bar(), 1).eigenvalues[0]);
  const int steps = 2000;
  for (int n = 0; n < steps; ++n) {
    body->begin_step();
    body->end_step(none);
  }
  const double left = std::exp(-2.0 * ratio * omega * 0.01 * steps);
  EXPECT_NEAR((body->kinetic_energy() + body->strain_energy()) / start / left, 1.0, 2.5 * ratio);
  EXPECT_LT(left, 0.9);
}

TEST(ModalStructure, GoesOnFromASavedStateToTheLastBit) {
  const structure::Supports supports = shaken();
  const auto first = modal(whole(bar(supports)), 8), second = modal(whole(bar(supports)), 8);
  const NodalForces forces = point_force(*first, {0.3, 0.6}, {0, 1, -5});
  const auto advance = [&](ModalStructure& body) {
    body.set_time_step(0.05);
    body.initialise_forces(forces);
    for (int n = 0; n < 20; ++n) {
      body.begin_step();
      body.end_step(forces);
    }
  };
  advance(*first);
  EXPECT_EQ(first->state_size(), first->save().size());
  second->load(first->save());
  advance(*first);
  advance(*second);
  EXPECT_EQ(first->positions(), second->positions());
  EXPECT_EQ(first->velocities(), second->velocities());
  EXPECT_EQ(first->work().supports, second->work().supports);
  std::vector<double> elsewhere = first->save();
  elsewhere.back() += 1e-9;  // other modes: the nodes count
  second->load(elsewhere);
  EXPECT_NE(first->save(), second->save());
  EXPECT_LT((first->positions() - second->positions()).norm(), 1e-12 * first->positions().norm());
  EXPECT_THROW(second->load({1.0}), std::invalid_argument);
}

}  // namespace
