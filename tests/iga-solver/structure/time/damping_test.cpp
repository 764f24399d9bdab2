// SPDX-License-Identifier: GPL-2.0-or-later
// Damping in proportion to the mass.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::ExplicitSolver;

void step(ExplicitSolver& body, const NodalVectors& F) {
  body.begin_step();
  body.end_step(F);
}

ExplicitSolver block(double rate, bool held) {
  const nurbs::Volume patch = models::block({2, 1, 1}, {4, 2, 2}, 2);
  structure::Supports supports;
  if (held) supports.fix(structure::nodes_on(patch.space, {Face::xi_minus}), {true, true, true});
  ExplicitSolver body(std::make_unique<structure::Solid>(patch, models::elastic()), supports);
  body.set_mass_damping(rate);
  body.set_time_step(0.5 * body.stable_time_step());
  return body;
}

// Free flight: the velocity of the half step loses (1 - a dt/2) / (1 + a dt/2) in each.
TEST(MassDamping, SlowsFreeFlightByTheExactFactor) {
  const double rate = 0.7;
  ExplicitSolver body = block(rate, false);
  const double dt = body.time_step(), factor = (1 - 0.5 * rate * dt) / (1 + 0.5 * rate * dt);
  const NodalVectors none = NodalVectors::Zero(3, body.body().node_count());
  const Vector3 v(1, -2, 0.5);
  body.set_velocities(v * Eigen::RowVectorXd::Ones(none.cols()));
  body.initialise_forces(none);
  Vector3 half = (1 - 0.5 * rate * dt) * v, u = Vector3::Zero();
  for (int n = 0; n < 50; ++n) {
    u += dt * half;
    step(body, none);
    ASSERT_LT((Vector3(body.displacements().col(7)) - u).norm(), 1e-13);
    half *= factor;
  }
  EXPECT_NEAR(body.work().damped, 0.5 * 2 * v.squaredNorm() - body.kinetic_energy(), 1e-13);
}

// Amplitudes of any mode fall as exp(-a t/2): the energy of a block that rings, over a time that is long.
TEST(MassDamping, TakesEnergyAtItsRate) {
  const double rate = 0.05;
  ExplicitSolver body = block(rate, true);
  NodalVectors none = NodalVectors::Zero(3, body.body().node_count());
  body.set_velocities(1e-3 * models::random_vectors(static_cast<int>(none.cols()), 3));
  body.initialise_forces(none);
  const double start = body.kinetic_energy();
  double log_start = 0.0, log_end = 0.0;
  const int steps = 4000, window = 500;
  for (int n = 0; n < steps; ++n) {
    step(body, none);
    const double energy = body.kinetic_energy() + body.strain_energy();
    if (n < window) log_start += std::log(energy) / window;
    if (n >= steps - window) log_end += std::log(energy) / window;
    const structure::Work work = body.work();
    ASSERT_NEAR(body.kinetic_energy() + work.internal + work.damped, start, 1e-12 * start);
  }
  EXPECT_NEAR((log_start - log_end) / ((steps - window) * body.time_step()), rate, 2e-3 * rate);
}

TEST(MassDamping, GoesOnFromASavedStateToTheLastBit) {
  ExplicitSolver one = block(0.2, true), other = block(0.2, true);
  const NodalVectors F = 1e-3 * models::random_vectors(one.body().node_count(), 8);
  one.initialise_forces(F);
  for (int n = 0; n < 20; ++n) step(one, F);
  other.load(one.save());
  other.initialise_forces(F);
  for (int n = 0; n < 20; ++n) step(one, F), step(other, F);
  EXPECT_EQ(one.save(), other.save());
}

}  // namespace
