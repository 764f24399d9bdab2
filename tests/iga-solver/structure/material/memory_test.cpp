// SPDX-License-Identifier: GPL-2.0-or-later
// A solid whose material remembers: the memory moves on with the steps and with nothing else.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "models.h"
#include "standard_linear_solid.h"
#include "structure/time/explicit_solver.h"
#include "structure/time/stable_time_step.h"

namespace {

using models::NodalVectors;
using structure::ExplicitSolver;
using structure::Matrix3;
using structure::Solid;

constexpr double kG = 0.3, kTau = 2.0;

std::unique_ptr<Solid> viscoelastic(int elements = 2) {
  const double side = elements;
  return std::make_unique<Solid>(
      models::distorted(models::block({side, side, side}, {elements, elements, elements}, 2), 0.1),
      std::make_shared<test::StandardLinearSolid>(1.0, 0.3, 1.0, kG, kTau));
}

/// Strained at once by u_A = H X_A, at time 0.
std::unique_ptr<Solid> stretched(const Matrix3& H, NodalVectors& u) {
  std::unique_ptr<Solid> solid = viscoelastic();
  u = models::linear_field(H, solid->reference());
  NodalVectors f(u);
  solid->evolve(u, 0.0, f);
  solid->commit();
  return solid;
}

/// Error of the stress after one relaxation time under held strain, relative to the stress at once:
/// P(t) = C : eps (g + (1 - g) exp(-t / tau)).
double relaxation_error(int steps) {
  NodalVectors u;
  const std::unique_ptr<Solid> body = stretched(0.01 * models::some_gradient(), u);
  Solid& solid = *body;
  const nurbs::Parameter<3> somewhere{0.2, 0.5, 0.9};
  const Matrix3 P0 = solid.stress(u, somewhere);
  NodalVectors f(u), f0(u);
  solid.internal_force(u, f0);
  for (int n = 0; n < steps; ++n) {
    solid.evolve(u, kTau / steps, f);
    solid.commit();
  }
  const double left = kG + (1.0 - kG) * std::exp(-1.0);
  const double error = (solid.stress(u, somewhere) - left * P0).norm() / P0.norm();
  EXPECT_NEAR((f - left * f0).norm() / f0.norm(), error, 1e-13) << "all points relax alike";
  return error;
}

TEST(Memory, RelaxesUnderHeldStrainAsInTheClosedFormToSecondOrder) {
  const double coarse = relaxation_error(20), fine = relaxation_error(40);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.01);
}

/// x(t) of a mode that starts with x = 0, x' = 1: each mode of the solid is a mass on the same standard
/// linear solid, x'' = -w^2 (x - (1 - g) z), tau z' = x - z.
double free_vibration(double w, double t) {
  Eigen::Matrix3d A;
  A << 0, 1, 0, -w * w, 0, (1.0 - kG) * w * w, 1.0 / kTau, 0, -1.0 / kTau;
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(Eigen::MatrixXd{A});
  const Eigen::Matrix3cd shapes = modes.eigenvectors();
  const Eigen::Vector3cd weights = shapes.fullPivLu().solve(Eigen::Vector3cd(Eigen::Vector3d(0, 1, 0)));
  const Eigen::Vector3cd grown = (modes.eigenvalues() * t).array().exp();
  return (shapes * weights.cwiseProduct(grown))[0].real();
}

/// Error of the amplitude after three time constants, relative to its first maximum.
double vibration_error(int index, int steps) {
  std::unique_ptr<Solid> body = viscoelastic();
  const Solid& solid = *body;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(models::mass_scaled_stiffness(solid, {}));
  const double w = std::sqrt(eigen.eigenvalues()[index]), end = 3.0 * kTau;
  NodalVectors mode = eigen.eigenvectors().col(index).reshaped(3, solid.node_count());
  mode *= solid.row_sum_mass().cwiseSqrt().cwiseInverse().asDiagonal();
  ExplicitSolver solver(std::move(body), {});
  const NodalVectors no_forces = NodalVectors::Zero(3, mode.cols());
  solver.set_velocities(mode);
  solver.set_time_step(end / steps);
  solver.initialise_forces(no_forces);
  for (int n = 0; n < steps; ++n) {
    solver.begin_step();
    solver.end_step(no_forces);
  }
  const double x = mode.cwiseProduct(solver.displacements()).sum() / mode.squaredNorm();
  EXPECT_LT((solver.displacements() - x * mode).norm(), 1e-10 * mode.norm()) << "it stays in its mode";
  return std::abs(x - free_vibration(w, end)) * w;
}

TEST(Memory, DampsFreeVibrationsAsInTheClosedFormToSecondOrder) {
  for (const int mode : {6, 12}) {
    const double coarse = vibration_error(mode, 400), fine = vibration_error(mode, 800);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.02);
  }
}

TEST(Memory, IsHeldByAllThatIsAskedOfAState) {
  NodalVectors u;
  const std::unique_ptr<Solid> body = stretched(0.01 * models::some_gradient(), u);
  Solid& solid = *body;
  const std::vector<double> before = solid.memory();
  NodalVectors once(u), twice(u), held(u);
  const structure::LumpedMass mass(solid.row_sum_mass());
  solid.evolve(u, 0.5, once);
  solid.internal_force(u, held);
  solid.strain_energy(u);
  structure::stable_time_step(solid, mass, {}, u);
  EXPECT_EQ(solid.memory(), before);
  solid.evolve(u, 0.5, twice);
  EXPECT_EQ(once, twice) << "a step that is worked out again is the same step";
  EXPECT_NE(once, held);
  solid.commit();
  EXPECT_NE(solid.memory(), before);
  solid.internal_force(u, held);
  EXPECT_EQ(held, twice) << "what is held after the step is what the step found";
}

// The energy is quadratic, so a central difference is exact.
TEST(Memory, HeldForcesAreTheGradientOfTheEnergy) {
  const std::unique_ptr<Solid> body = viscoelastic();
  Solid& solid = *body;
  const auto random = [&](unsigned seed) { return models::random_vectors(solid.node_count(), seed); };
  NodalVectors f(3, solid.node_count());
  solid.evolve(random(1), 0.7, f);
  solid.commit();  // each point remembers another strain
  const NodalVectors u = random(2), d = random(3);
  solid.internal_force(u, f);
  const double slope = 0.5 * (solid.strain_energy(u + d) - solid.strain_energy(u - d));
  EXPECT_NEAR(f.cwiseProduct(d).sum(), slope, 1e-12 * solid.strain_energy(u));
}

TEST(Memory, StableStepIsThatOfTheLawAtOnce) {
  NodalVectors u;
  const std::unique_ptr<const Solid> body = stretched(0.01 * models::some_gradient(), u);
  const Solid& solid = *body;
  const Solid elastic({solid.space(), solid.reference()}, models::elastic());
  const structure::LumpedMass mass(solid.row_sum_mass());
  const double expected = structure::stable_time_step(elastic, mass, {}, u);
  EXPECT_NEAR(structure::stable_time_step(solid, mass, {}, u), expected, 1e-6 * expected);
}

void run(ExplicitSolver& solver, int steps) {
  const NodalVectors pull = NodalVectors::Constant(3, solver.body().node_count(), 1e-3);
  for (int n = 0; n < steps; ++n) {
    solver.begin_step();
    solver.end_step(pull);
  }
}

TEST(Memory, ContinuesFromASavedStateToTheLastBit) {
  ExplicitSolver first(viscoelastic(), {});
  first.set_velocities(models::random_vectors(first.body().node_count(), 5));
  first.set_time_step(0.2);
  first.initialise_forces(NodalVectors::Constant(3, first.body().node_count(), 1e-3));
  run(first, 20);
  const std::vector<double> state = first.save();
  run(first, 20);
  for (const bool initialises : {false, true}) {
    ExplicitSolver second(viscoelastic(), {});
    second.set_time_step(0.2);
    second.load(state);
    if (initialises) second.initialise_forces(NodalVectors::Constant(3, second.body().node_count(), 1e-3));
    run(second, 20);
    EXPECT_EQ(first.save(), second.save());
  }
}

TEST(Memory, OfABodyThatIsPutSomewhereIsThatAtOnce) {
  NodalVectors u;
  const std::unique_ptr<Solid> expected = stretched(0.01 * models::some_gradient(), u);
  ExplicitSolver solver(viscoelastic(), {});
  solver.set_motion(u, NodalVectors::Zero(3, u.cols()), 0.0);
  solver.settle();
  EXPECT_EQ(solver.body().memory(), expected->memory());
}

TEST(Memory, OfAnotherSizeIsRefused) {
  ExplicitSolver solver(viscoelastic(), {});
  std::vector<double> state = solver.save();
  const std::size_t nodes = solver.body().node_count(), points = 8 * 27;
  ASSERT_EQ(state.size(), 1 + 9 * nodes + 18 * points);
  state.resize(1 + 9 * nodes);  // of an elastic solid
  EXPECT_THROW(solver.load(state), std::invalid_argument);
  EXPECT_THROW(viscoelastic()->set_memory({1.0}), std::invalid_argument);
}

}  // namespace
