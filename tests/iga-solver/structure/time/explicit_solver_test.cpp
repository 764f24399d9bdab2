// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "models.h"
#include "structure/conditions/loads.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::ExplicitSolver;
using structure::Solid;
using structure::Supports;

ExplicitSolver cubes(int n, Supports supports = {}) {
  return ExplicitSolver(
      std::make_unique<Solid>(models::block({1.0 * n, 1.0 * n, 1.0 * n}, {n, n, n}, 2), models::elastic()),
      supports);
}

void run_free(ExplicitSolver& solver, int steps) {
  const NodalVectors F = models::no_forces(solver);
  for (int n = 0; n < steps; ++n) {
    solver.begin_step();
    solver.end_step(F);
  }
}

// A mode of frequency w obeys u(n+1) - 2 u(n) + u(n-1) = -(w dt)^2 u(n) exactly: u(n) = cos(n theta) with
// cos(theta) = 1 - (w dt)^2 / 2, and v(n) = (u(n+1) - u(n-1)) / 2 dt.
TEST(CentralDifference, MovesEveryModeWithItsDiscreteFrequency) {
  ExplicitSolver solver = cubes(2);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      models::mass_scaled_stiffness(solver.body(), {}));
  const Eigen::VectorXd root_mass = solver.mass().nodal_mass().cwiseSqrt();
  const NodalVectors start = models::no_forces(solver);
  for (int index : {6, 40, int(eigen.eigenvalues().size()) - 1}) {
    const double dt = 1.8 / std::sqrt(eigen.eigenvalues().maxCoeff());
    const double w_dt = std::sqrt(eigen.eigenvalues()[index]) * dt;
    const double theta = std::acos(1.0 - 0.5 * w_dt * w_dt);
    NodalVectors mode = eigen.eigenvectors().col(index).reshaped(3, root_mass.size());
    mode *= root_mass.cwiseInverse().asDiagonal();
    models::set_displacements(solver, mode);
    solver.set_velocities(start);
    solver.set_time_step(dt);
    solver.initialise_forces(start);
    const int steps = 57;
    run_free(solver, steps);
    EXPECT_LT((solver.displacements() - std::cos(steps * theta) * mode).norm(), 1e-10 * mode.norm());
    const double slope = -std::sin(steps * theta) * std::sin(theta) / dt;
    EXPECT_LT((solver.velocities() - slope * mode).norm(), 1e-10 * mode.norm() / dt);
  }
}

struct EnergyHistory {
  double largest_error, drift;  // relative to the initial energy
};

// PHYSICS C15: free block of 4 x 4 x 4 cubes, random initial velocity.
EnergyHistory energy_history(double step_factor) {
  ExplicitSolver solver = cubes(4);
  solver.set_velocities(models::random_vectors(solver.body().node_count(), 5));
  solver.set_time_step(step_factor * 0.6454);
  solver.initialise_forces(models::no_forces(solver));
  const double E0 = solver.kinetic_energy();
  const int blocks = 4, steps = static_cast<int>(40.0 / step_factor);
  double largest = 0.0, mean[blocks] = {};
  for (double& block_mean : mean)
    for (int n = 0; n < steps; ++n) {
      run_free(solver, 1);
      const double error = (solver.kinetic_energy() + solver.strain_energy()) / E0 - 1.0;
      largest = std::max(largest, std::abs(error));
      block_mean += error / steps;
    }
  return {largest, mean[blocks - 1] - mean[1]};
}

TEST(CentralDifference, KeepsEnergyToSecondOrderWithoutDrift) {
  const EnergyHistory coarse = energy_history(0.2), fine = energy_history(0.1);
  EXPECT_LT(coarse.largest_error, 2.0 * 3.2e-3);
  EXPECT_LT(fine.largest_error, 2.0 * 8.0e-4);
  EXPECT_NEAR(coarse.largest_error / fine.largest_error, 4.0, 0.6);
  EXPECT_LT(std::abs(coarse.drift), 0.05 * coarse.largest_error);
  EXPECT_LT(std::abs(fine.drift), 0.05 * fine.largest_error);
}

TEST(CentralDifference, KeepsLinearMomentumToRoundOff) {
  ExplicitSolver solver = cubes(2);
  solver.set_velocities(models::random_vectors(solver.body().node_count(), 5));
  solver.set_time_step(0.5);
  solver.initialise_forces(models::no_forces(solver));
  const Vector3 before = solver.linear_momentum();
  run_free(solver, 1000);
  EXPECT_LT((solver.linear_momentum() - before).norm(), 1e-11 * before.norm());
}

TEST(CentralDifference, FallsExactlyUnderGravity) {
  ExplicitSolver solver = cubes(2);
  const Vector3 g(0.1, -0.2, 0.3);
  solver.set_load(structure::gravity_load(solver.body(), g));
  solver.set_time_step(0.3);
  solver.initialise_forces(models::no_forces(solver));
  run_free(solver, 50);
  const double t = 50 * 0.3, mass = solver.mass().nodal_mass().sum();
  EXPECT_NEAR(solver.time(), t, 1e-12);
  for (int A = 0; A < solver.positions().cols(); ++A)
    EXPECT_LT((solver.displacements().col(A) - 0.5 * t * t * g).norm(), 1e-10);
  EXPECT_NEAR(solver.kinetic_energy(), 0.5 * mass * g.squaredNorm() * t * t, 1e-9);
  EXPECT_NEAR(solver.load_work(), solver.kinetic_energy(), 1e-9);
  EXPECT_LT((solver.positions() - solver.body().reference() - solver.displacements()).norm(), 1e-12);
}

TEST(ExplicitSolver, GivesTheMomentaOfRigidMotion) {
  ExplicitSolver solver = cubes(2);
  const Vector3 V(1, 2, -1), omega(0.3, -0.1, 0.7), about(5, 0, 1), centre(1, 1, 1);
  NodalVectors v = models::no_forces(solver);
  for (int A = 0; A < v.cols(); ++A) v.col(A) = V + omega.cross(Vector3(solver.positions().col(A)) - centre);
  solver.set_velocities(v);
  // Cube of side 2, density 1: mass 8, moment of inertia 16/3 about any axis; lumped with 2 elements: 1.5
  // times that (C16).
  EXPECT_LT((solver.linear_momentum() - 8.0 * V).norm(), 1e-12);
  const Vector3 expected = (centre - about).cross(8.0 * V) + 1.5 * (16.0 / 3.0) * omega;
  EXPECT_LT((solver.angular_momentum(about) - expected).norm(), 1e-12);
  EXPECT_NEAR(solver.kinetic_energy(), 0.5 * (8.0 * V.squaredNorm() + 8.0 * omega.squaredNorm()), 1e-12);
}

TEST(ExplicitSolver, HoldsFixedDofsAndNoOthers) {
  Supports supports;
  supports.fix(structure::nodes_on(models::block({2, 2, 2}, {2, 2, 2}, 2).space, {Face::zeta_minus}),
               {true, false, true});
  ExplicitSolver solver = cubes(2, supports);
  solver.set_velocities(models::random_vectors(solver.body().node_count(), 5));
  solver.set_time_step(0.3);
  solver.initialise_forces(models::random_vectors(solver.body().node_count(), 6));
  run_free(solver, 10);
  for (int dof = 0; dof < solver.displacements().size(); ++dof) {
    const bool fixed = dof / 3 < 16 && dof % 3 != 1;  // the first 4 x 4 control points lie on zeta-
    EXPECT_EQ(solver.displacements().data()[dof] == 0.0, fixed) << dof;
    EXPECT_EQ(solver.velocities().data()[dof] == 0.0, fixed) << dof;
  }
}

TEST(ExplicitSolver, InitialisingForcesAdvancesNothing) {
  ExplicitSolver solver = cubes(2);
  const NodalVectors F = models::random_vectors(solver.body().node_count(), 5);
  solver.initialise_forces(F);
  EXPECT_EQ(solver.time(), 0.0);
  EXPECT_EQ(solver.displacements(), models::no_forces(solver));
  EXPECT_EQ(solver.velocities(), models::no_forces(solver));
  for (int A = 0; A < F.cols(); ++A)
    EXPECT_LT((solver.accelerations().col(A) * solver.mass().nodal_mass()[A] - F.col(A)).norm(), 1e-15);
}

TEST(ExplicitSolver, ContinuesFromASavedStateToTheLastBit) {
  ExplicitSolver solver = cubes(2);
  solver.set_velocities(models::random_vectors(solver.body().node_count(), 5));
  solver.set_time_step(0.3);
  solver.initialise_forces(models::no_forces(solver));
  run_free(solver, 7);
  const std::vector<double> saved = solver.save();
  const NodalVectors saved_positions = solver.positions();
  run_free(solver, 7);
  ExplicitSolver other = cubes(2);
  other.set_time_step(0.3);
  other.load(saved);
  EXPECT_EQ(other.positions(), saved_positions);
  run_free(other, 7);
  EXPECT_EQ(other.save(), solver.save());
  EXPECT_EQ(other.positions(), solver.positions());
}

// Works summed here from positions, velocities and forces, half kick by half kick; a constant load's in
// closed form: f . (u + dt^2/8 a) between the ends.
TEST(ExplicitSolver, ItsLedgerOfWorkIsClosedToRoundOff) {
  Supports supports;
  const nurbs::Volume patch = models::distorted(models::block({3.0, 2.0, 1.0}, {3, 2, 1}, 2), 0.1);
  supports.fix(structure::nodes_on(patch.space, {Face::xi_minus}), {true, true, false});
  ExplicitSolver solver(std::make_unique<Solid>(patch, models::elastic()), supports);
  const int nodes = solver.body().node_count();
  const NodalVectors load = structure::gravity_load(solver.body(), {0.3, -0.2, 0.5});
  solver.set_load(load);
  solver.set_velocities(models::random_vectors(nodes, 3));
  const double dt = 0.3 * solver.stable_time_step();
  solver.set_time_step(dt);
  NodalVectors F = 0.1 * models::random_vectors(nodes, 10), f_int(3, nodes), before;
  solver.initialise_forces(F);
  solver.begin_step(), solver.end_step(F);  // the ledger begins anew with each run
  solver.initialise_forces(F);
  EXPECT_EQ(solver.work().internal, 0.0);
  const double K_0 = solver.kinetic_energy(), U_0 = solver.strain_energy();
  const double load_0 =
      load.cwiseProduct(solver.displacements() + dt * dt / 8 * solver.accelerations()).sum();
  double internal = 0.0, forces = 0.0, turned_over = 0.0;
  for (int n = 1; n <= 500; ++n) {
    const auto kick = [&](const NodalVectors& v, const NodalVectors& w) {
      solver.body().internal_force(solver.displacements(), f_int);
      internal += 0.25 * dt * f_int.cwiseProduct(v + w).sum();
      forces += 0.25 * dt * F.cwiseProduct(v + w).sum();
    };
    before = solver.velocities();
    const NodalVectors half = before + 0.5 * dt * solver.accelerations();
    kick(before, half);
    solver.begin_step();
    F = 0.1 * models::random_vectors(nodes, 10 + n);
    solver.end_step(F);
    kick(half, solver.velocities());
    const structure::Work work = solver.work();
    turned_over = std::max({turned_over, solver.kinetic_energy(), solver.strain_energy()});
    EXPECT_NEAR(solver.kinetic_energy() - K_0 + work.internal - work.loads - work.forces, 0.0,
                1e-13 * turned_over);
    EXPECT_NEAR(work.internal, internal, 1e-12 * turned_over);
    EXPECT_NEAR(work.forces, forces, 1e-12 * turned_over);
    const double load_now =
        load.cwiseProduct(solver.displacements() + dt * dt / 8 * solver.accelerations()).sum();
    EXPECT_NEAR(work.loads, load_now - load_0, 1e-12 * turned_over);
    EXPECT_NEAR(work.internal, solver.strain_energy() - U_0, 0.05 * turned_over)
        << "up to the error of the step";
  }
}

TEST(ExplicitSolver, RefusesWrongArguments) {
  ExplicitSolver solver = cubes(1);
  const NodalVectors wrong = NodalVectors::Zero(3, 5);
  EXPECT_THROW(solver.begin_step(), std::logic_error);
  for (double dt : {0.0, -1.0, std::nan("")}) EXPECT_THROW(solver.set_time_step(dt), std::invalid_argument);
  EXPECT_THROW(solver.set_load(wrong), std::invalid_argument);
  EXPECT_THROW(solver.set_velocities(wrong), std::invalid_argument);
  EXPECT_THROW(solver.initialise_forces(wrong), std::invalid_argument);
  EXPECT_THROW(solver.end_step(wrong), std::invalid_argument);
  EXPECT_THROW(solver.load({1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(structure::LumpedMass(Eigen::Vector2d(1.0, 0.0)), std::invalid_argument);
}

}  // namespace
