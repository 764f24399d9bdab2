// SPDX-License-Identifier: GPL-2.0-or-later
// Solids that blow up are stopped at once, and no others.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "models.h"
#include "structure/conditions/loads.h"
#include "structure/material/laws.h"
#include "structure/time/explicit_solver.h"
#include "structure/time/stable_time_step.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::Diverged;
using structure::ExplicitSolver;
using structure::Solid;
using structure::Supports;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

ExplicitSolver cubes_of(int n, std::shared_ptr<const structure::Material> material = models::elastic(),
                        Supports supports = {}) {
  return ExplicitSolver(
      std::make_unique<Solid>(models::block({1.0 * n, 1.0 * n, 1.0 * n}, {n, n, n}, 2), std::move(material)),
      std::move(supports));
}

// Runs to the end that is expected, within `most` steps, and returns its message.
std::string message_of_divergence(ExplicitSolver& solver, const NodalVectors& F, int most) {
  try {
    for (int n = 0; n < most; ++n) models::step(solver, F);
  } catch (const Diverged& error) {
    return error.what();
  }
  return "not noticed";
}

// Above the stable step, q = (w dt)^2 / 4 > 1, a mode that is let go grows as u(n) = (-1)^n cosh(n phi),
// cosh(phi) = 2 q - 1, so its kinetic energy is sinh^2(n phi) sinh^2(phi) in units of m / 2 dt^2; at first it
// had the strain energy 4 q and the first kick 4 q^2.
TEST(Divergence, OfATooLongStepIsNoticedInTheStepThatTheoryNames) {
  ExplicitSolver solver = cubes_of(2);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      models::mass_scaled_stiffness(solver.body(), {}));
  NodalVectors mode = eigen.eigenvectors().rightCols(1).reshaped(3, solver.body().node_count());
  mode *= solver.mass().nodal_mass().cwiseSqrt().cwiseInverse().asDiagonal();
  const double highest = eigen.eigenvalues().maxCoeff(), dt = 1.01 * 2.0 / std::sqrt(highest);
  const double stable = solver.stable_time_step(), q = 0.25 * highest * dt * dt,
               phi = std::acosh(2.0 * q - 1.0);
  int expected = 1;
  while (std::pow(std::sinh(expected * phi) * std::sinh(phi), 2) <= 10.0 * 4.0 * (q + q * q)) ++expected;
  ASSERT_GT(expected, 5);

  models::set_displacements(solver, mode);
  solver.set_time_step(dt);
  solver.initialise_forces(models::no_forces(solver));
  for (int n = 1; n < expected; ++n) models::step(solver, models::no_forces(solver));
  EXPECT_THAT([&] { models::step(solver, models::no_forces(solver)); },
              testing::ThrowsMessage<Diverged>(
                  AllOf(HasSubstr(fmt::format("at time {:.6g}:", expected * dt)), HasSubstr("kinetic energy"),
                        HasSubstr("control node"), HasSubstr(fmt::format("time step {:.6g} is too long", dt)),
                        HasSubstr(structure::step_text(stable)))));
}

// One corner of the block is pushed through it.
TEST(Divergence, NamesTheElementThatFolds) {
  Supports supports;
  supports.fix(structure::nodes_on(models::block({2, 2, 2}, {2, 2, 2}, 2).space, {Face::zeta_minus}),
               {true, true, true});
  ExplicitSolver solver =
      cubes_of(2, std::make_shared<structure::SaintVenantKirchhoff>(1.0, 0.3, 1.0), supports);
  NodalVectors F = models::no_forces(solver);
  F.col(F.cols() - 1) = Vector3(-0.3, -0.3, -0.3);
  solver.set_time_step(0.57);  // below the stable step, for which nobody asks: strains are not watched
  solver.initialise_forces(F);
  EXPECT_THAT(
      message_of_divergence(solver, F, 1000),
      AllOf(
          HasSubstr("the solid has blown up at time"), HasSubstr("control node 63, undeformed at (2, 2, 2)"),
          HasSubstr("element 7 (spans 1, 1, 1 of xi, eta, zeta, undeformed about (1.5, 1.5, 1.5)) is folded"),
          HasSubstr("forces")));
  EXPECT_LE(solver.time(), 1000 * solver.time_step());
  EXPECT_TRUE(solver.displacements().allFinite());
}

TEST(Divergence, NamesTheNodeWithAForceThatIsNoNumber) {
  ExplicitSolver solver = cubes_of(1);
  NodalVectors F = models::no_forces(solver);
  F(1, 4) = std::nan("");
  solver.set_time_step(0.1);
  const auto expected = testing::ThrowsMessage<Diverged>(
      AllOf(HasSubstr("time 0:"), HasSubstr("the contact force is not finite at control node 4")));
  EXPECT_THAT([&] { solver.initialise_forces(F); }, expected);
}

TEST(Divergence, IsWhatCannotBeSquared) {
  for (const double size : {1.1e100, std::numeric_limits<double>::infinity()}) {
    ExplicitSolver solver = cubes_of(1);
    NodalVectors u = models::no_forces(solver);
    u.row(2).setConstant(size);
    models::set_displacements(solver, u);
    solver.set_time_step(0.1);
    EXPECT_THAT(
        [&] { solver.initialise_forces(models::no_forces(solver)); },
        testing::ThrowsMessage<Diverged>(AllOf(HasSubstr("displacement"), HasSubstr("control node 0"))));
  }
}

TEST(Divergence, IsNotForTheTimeStepOfASolidThatHasTakenNone) {
  ExplicitSolver solver = cubes_of(1);
  NodalVectors u = models::no_forces(solver);
  u.row(2).setConstant(1e110);
  models::set_displacements(solver, u);
  EXPECT_THAT([&] { solver.initialise_forces(models::no_forces(solver)); },
              testing::ThrowsMessage<Diverged>(
                  AllOf(HasSubstr("displacement"), HasSubstr("loads"), Not(HasSubstr("time step")))));
}

// The energy that it was given is not finite either.
TEST(Divergence, IsAKineticEnergyThatOverflows) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(structure::EnergyBudget(kInfinity, 0.0).allows(kInfinity));
  EXPECT_TRUE(structure::EnergyBudget(kInfinity, 0.0).allows(1e300));
  ExplicitSolver solver = cubes_of(1, models::elastic(1.0, 0.3, 1e120));
  NodalVectors v = models::no_forces(solver);
  v.row(0).setConstant(1e100);
  solver.set_velocities(v);
  solver.set_time_step(0.1);
  EXPECT_THAT([&] { solver.initialise_forces(models::no_forces(solver)); },
              testing::ThrowsMessage<Diverged>(
                  AllOf(HasSubstr("kinetic energy is not finite"), HasSubstr("initial velocities"))));
}

// Forces that change at random from step to step, near the longest step that users may take: whatever they
// do, the kinetic energy is never above what was given.
TEST(Divergence, IsNotSeenInAStableSolid) {
  ExplicitSolver solver = cubes_of(2);
  const double dt = 0.98 * solver.stable_time_step();
  double given = 0.0, power = 0.0;
  for (unsigned n = 0; n < 3000; ++n) {
    const NodalVectors F = models::random_vectors(solver.body().node_count(), n);
    if (n % 1000 == 0) {  // from rest: kicked off by the first force
      solver = cubes_of(2);
      solver.set_time_step(dt);
      solver.initialise_forces(F);
      power = 0.0;
      given =
          0.125 * dt * dt * solver.accelerations().colwise().squaredNorm().dot(solver.mass().nodal_mass());
      continue;
    }
    ASSERT_NO_THROW(models::step(solver, F)) << n;
    const double previous = std::exchange(power, F.cwiseProduct(solver.velocities()).sum());
    given += 0.5 * dt * (previous + power);
    ASSERT_LE(solver.kinetic_energy(), given * (1.0 + 1e-9)) << n;
  }
}

// A solid that was moved far away and left there has the strain of round-off, and forces to go with it.
TEST(Divergence, IsNotSeenInRoundOff) {
  ExplicitSolver solver = cubes_of(2);
  NodalVectors u = models::no_forces(solver);
  u.row(0).setConstant(1234.5678);
  models::set_displacements(solver, u);
  solver.set_time_step(0.98 * solver.stable_time_step());
  solver.initialise_forces(models::no_forces(solver));
  for (int n = 0; n < 3000; ++n) ASSERT_NO_THROW(models::step(solver, models::no_forces(solver))) << n;
}

}  // namespace
