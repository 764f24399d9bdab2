// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/stretch_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/material/saint_venant_kirchhoff.h"
#include "structure/time/explicit_solver.h"
#include "structure/time/stable_time_step.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::Diverged;
using structure::ExplicitSolver;
using structure::Solid;
using structure::StretchWatch;
using testing::HasSubstr;

std::shared_ptr<const structure::Material> svk(double nu) {
  return std::make_shared<structure::SaintVenantKirchhoff>(1.0, nu, 1.0);
}

NodalVectors positions(const Solid& solid, const models::Matrix3& H) {
  return solid.reference() + models::linear_field(H, solid.reference());
}

models::Matrix3 along(int axis, double stretch) {
  models::Matrix3 H = models::Matrix3::Zero();
  H(axis, axis) = stretch - 1.0;
  return H;
}

bool rings_in_a_round(StretchWatch& watch, const NodalVectors& x) {
  bool rings = false;
  for (int turn = 0; turn < 8; ++turn) rings |= watch.look(x);
  return rings;
}

// nu = 0: nothing across, (3 s^2 - 1) / 2 along the fibre.
TEST(StretchWatch, KnowsWhatStretchDoesToTheLaw) {
  for (const double s : {0.8, 1.0, 1.1, 1.5})
    EXPECT_NEAR(structure::stretched_stiffness(*svk(0.0), s), std::max(0.5 * (3 * s * s - 1), 0.0), 1e-6);
  for (const double s : {0.5, 1.0, 2.0})
    EXPECT_NEAR(structure::stretched_stiffness(*models::elastic(1.0, 0.0), s), 1.0, 1e-6);
}

TEST(StretchWatch, RingsAtTheStretchThatIsNotAllowed) {
  const Solid solid(models::block({3, 2, 1}, {3, 2, 2}, 2), svk(0.0));
  const double allowed = 1.2, limit = std::sqrt((2.0 * allowed + 1.0) / 3.0);
  for (int axis = 0; axis < 3; ++axis) {
    StretchWatch watch(solid, allowed);
    EXPECT_FALSE(rings_in_a_round(watch, positions(solid, along(axis, limit - 1e-3))));
    EXPECT_FALSE(rings_in_a_round(watch, positions(solid, along(axis, 0.5)))) << "it gets softer";
    EXPECT_TRUE(rings_in_a_round(watch, positions(solid, along(axis, limit + 1e-3))));
    watch.allow_more(1.1);
    EXPECT_FALSE(rings_in_a_round(watch, positions(solid, along(axis, limit + 1e-3))));
  }
}

TEST(StretchWatch, IsSilentForRotationsAndForALinearLaw) {
  const double turned = 1.0;
  models::Matrix3 R = Eigen::AngleAxisd(turned, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Solid solid(models::block({3, 2, 1}, {3, 2, 2}, 2), svk(0.3));
  StretchWatch watch(solid, 1.0001);
  EXPECT_FALSE(rings_in_a_round(watch, positions(solid, R - models::Matrix3::Identity())));
  const Solid linear({solid.space(), solid.reference()}, models::elastic());
  StretchWatch of_linear(linear, 1.0);
  EXPECT_FALSE(rings_in_a_round(of_linear, positions(linear, along(0, 9.0))));
}

// Wherever it is, one strained element is found within eight steps.
TEST(StretchWatch, SeesEveryElement) {
  const Solid solid(models::block({3, 3, 3}, {3, 3, 3}, 1), svk(0.3));
  for (int node = 0; node < solid.node_count(); ++node) {
    NodalVectors x = solid.reference();
    x.col(node) += (x.col(node) - Vector3(1.5, 1.5, 1.5)) * 0.3;
    StretchWatch watch(solid, 1.1);
    EXPECT_TRUE(rings_in_a_round(watch, x)) << node;
    EXPECT_GT(watch.rung() ? watch.rung()->stretch : 1.1, 1.05);
  }
}

/// A bar along x, nu = 0, its sides held, pulled apart slowly at a rate of strain.
ExplicitSolver pulled_bar(std::shared_ptr<const structure::Material> material, double rate) {
  const nurbs::Volume patch = models::block({8, 100, 100}, {8, 1, 1}, {2, 1, 1});
  structure::Supports supports;
  for (Face face : {Face::eta_minus, Face::zeta_minus, Face::eta_plus, Face::zeta_plus})
    supports.fix(structure::nodes_on(patch.space, {face}), {false, true, true});
  ExplicitSolver solver(std::make_unique<Solid>(patch, std::move(material)), supports);
  NodalVectors v = NodalVectors::Zero(3, solver.body().node_count());
  v.row(0) = rate * patch.control_points.row(0);
  solver.set_velocities(v);
  return solver;
}

struct End {
  double stretch = 1.0;  // of the bar
  std::string message;
};

End pull(ExplicitSolver& solver, double dt, int steps) {
  const NodalVectors none = NodalVectors::Zero(3, solver.body().node_count());
  solver.set_time_step(dt);
  End end;
  try {
    solver.initialise_forces(none);
    for (int n = 0; n < steps; ++n) {
      solver.begin_step();
      solver.end_step(none);
      end.stretch = 1.0 + solver.displacements().row(0).maxCoeff() / 8.0;
    }
  } catch (const Diverged& problem) {
    end.message = problem.what();
  }
  return end;
}

// Its ends fly apart faster than the waves can call them back: all of the bar is stretched alike at first.
TEST(StretchWatch, StopsAStretchedBarAtThePredictedStretch) {
  ExplicitSolver solver = pulled_bar(svk(0.0), 0.5);
  const double stable = solver.stable_time_step();
  for (const double share : {0.95, 0.85}) {
    solver = pulled_bar(svk(0.0), 0.5);
    solver.stable_time_step();
    const End end = pull(solver, share * stable, 100);
    const double predicted = std::sqrt((2.0 / (share * share) + 1.0) / 3.0);
    EXPECT_NEAR(end.stretch, predicted, 0.5 * share * stable * 2.0);  // a step or two of the motion
    EXPECT_THAT(end.message, testing::AllOf(HasSubstr("stable step"), HasSubstr("below the time step"),
                                            HasSubstr("times as long at control node")));
    EXPECT_LT(solver.stable_time_step_now(), share * stable);
    EXPECT_EQ(solver.stable_time_step(), stable) << "that of the start";
  }
}

TEST(StretchWatch, LeavesARunWithRoomAlone) {
  ExplicitSolver slow = pulled_bar(svk(0.0), 0.02);
  const double stable = slow.stable_time_step();
  EXPECT_EQ(pull(slow, 0.9 * stable, 300).message, "");
  EXPECT_EQ(slow.stable_time_step_now(), stable) << "not worked out anew";
  ExplicitSolver linear = pulled_bar(models::elastic(1.0, 0.0), 0.5);
  linear.stable_time_step();
  EXPECT_EQ(pull(linear, 0.99 * stable, 100).message, "");
}

TEST(StretchWatch, CountsWhatDampingTakes) {
  ExplicitSolver solver = pulled_bar(svk(0.0), 0.15);
  const double stable = solver.stable_time_step(), share = 0.7, lead = 0.25 * stable;
  solver.set_lead(lead);
  const End end = pull(solver, share * stable, 100);
  const double predicted = std::sqrt((2.0 / (share * (share + 0.5)) + 1.0) / 3.0);
  EXPECT_NEAR(end.stretch, predicted, 0.15 * share * stable * 2.0);
  EXPECT_GT(solver.stable_time_step_now(), share * stable) << "without damping there would be room";
}

TEST(StretchWatch, LeavesItToSomebodyWhoAsksForThat) {
  ExplicitSolver solver = pulled_bar(svk(0.0), 0.1);
  const double stable = solver.stable_time_step();
  const NodalVectors none = NodalVectors::Zero(3, solver.body().node_count());
  solver.go_on_when_strained();
  solver.set_time_step(0.95 * stable);
  solver.initialise_forces(none);
  const double start = solver.kinetic_energy();
  int steps = 0;
  for (; !solver.is_too_strained() && steps < 100; ++steps) {
    solver.begin_step();
    solver.end_step(none);
  }
  EXPECT_LT(steps, 100);
  EXPECT_LT(solver.stable_time_step_now(), 0.95 * stable);
  EXPECT_EQ(solver.renew_stable_time_step(), solver.stable_time_step_now());
  solver.set_time_step(0.5 * stable);
  EXPECT_FALSE(solver.is_too_strained());
  NodalVectors push = none;
  push.row(0).setConstant(100.0);
  solver.change_forces(push);
  for (int n = 0; n < 10; ++n) {
    solver.begin_step();
    solver.end_step(push);
  }
  EXPECT_FALSE(solver.is_too_strained());
  const structure::Work work = solver.work();
  EXPECT_GT(work.forces, 0.0);
  EXPECT_NEAR(solver.kinetic_energy() + work.internal - work.forces, start, 1e-12 * start) << "the ledger";
}

TEST(StretchWatch, TheStableStepOfAStateIsThatOfItsStrain) {
  ExplicitSolver linear = pulled_bar(models::elastic(1.0, 0.0), 0.5), bar = pulled_bar(svk(0.0), 0.5);
  const double stable = bar.stable_time_step();
  EXPECT_EQ(bar.renew_stable_time_step(), stable) << "not strained yet";
  for (ExplicitSolver* solver : {&linear, &bar}) {
    solver->stable_time_step();
    pull(*solver, 0.4 * stable, 3);
  }
  EXPECT_LT(bar.renew_stable_time_step(), 0.98 * stable);
  EXPECT_EQ(linear.renew_stable_time_step(), linear.stable_time_step());
  // Whenever it is asked for first.
  ExplicitSolver again = pulled_bar(svk(0.0), 0.5);
  again.load(bar.save());
  EXPECT_EQ(again.stable_time_step(), stable);
  EXPECT_EQ(again.renew_stable_time_step(), bar.renew_stable_time_step());
}

}  // namespace
