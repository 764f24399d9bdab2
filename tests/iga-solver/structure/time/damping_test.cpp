// SPDX-License-Identifier: GPL-2.0-or-later
// Damping in proportion to the mass, and to the stiffness.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "models.h"
#include "structure/material/viscous.h"
#include "structure/time/explicit_solver.h"
#include "structure/time/spin.h"
#include "structure/time/stable_time_step.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::ExplicitSolver;

class MassDamping : public testing::TestWithParam<structure::TimeMass> {};
INSTANTIATE_TEST_SUITE_P(Of, MassDamping,
                         testing::Values(structure::TimeMass::lumped, structure::TimeMass::corrected),
                         [](const auto& mass) { return structure::name(mass.param); });

ExplicitSolver block(double rate, bool held, structure::TimeMass mass) {
  const nurbs::Volume patch = models::distorted(models::block({2, 1, 1}, {4, 2, 2}, 2), 0.05);
  structure::Supports supports;
  if (held) supports.fix(structure::nodes_on(patch.space, {Face::xi_minus}), {true, true, true});
  ExplicitSolver body(
      std::make_unique<structure::Solid>(patch, models::elastic(), structure::Integration{{}, {}, mass}),
      supports);
  body.set_mass_damping(rate);
  body.set_time_step(0.5 * body.stable_time_step());
  return body;
}

// Free flight: the velocity of the half step loses (1 - a dt/2) / (1 + a dt/2) in each.
TEST_P(MassDamping, SlowsFreeFlightByTheExactFactor) {
  const double rate = 0.7;
  ExplicitSolver body = block(rate, false, GetParam());
  const double dt = body.time_step(), factor = (1 - 0.5 * rate * dt) / (1 + 0.5 * rate * dt);
  const NodalVectors none = NodalVectors::Zero(3, body.body().node_count());
  const Vector3 v(1, -2, 0.5);
  for (const Vector3& some : {Vector3(-v), v}) {  // the last ones count
    body.set_velocities(some * Eigen::RowVectorXd::Ones(none.cols()));
    body.initialise_forces(none);
  }
  Vector3 half = (1 - 0.5 * rate * dt) * v, u = Vector3::Zero();
  for (int n = 0; n < 50; ++n) {
    u += dt * half;
    models::step(body, none);
    ASSERT_LT((Vector3(body.displacements().col(7)) - u).norm(), 1e-13);
    half *= factor;
  }
  const double mass = body.mass().nodal_mass().sum();
  EXPECT_NEAR(body.work().damped, 0.5 * mass * v.squaredNorm() - body.kinetic_energy(), 1e-13);
}

TEST_P(MassDamping, IsNoMoreThanTurnsVelocitiesRound) {
  ExplicitSolver body = block(0.7, false, GetParam());
  body.set_mass_damping(1.99 / body.time_step());
  EXPECT_NO_THROW(body.set_time_step(body.time_step()));
  body.set_mass_damping(2.01 / body.time_step());
  EXPECT_THROW(body.set_time_step(body.time_step()), std::invalid_argument);
}

// Amplitudes of any mode fall as exp(-a t/2): the energy of a block that rings, over a time that is long.
TEST_P(MassDamping, TakesEnergyAtItsRate) {
  const double rate = 0.05;
  ExplicitSolver body = block(rate, true, GetParam());
  NodalVectors none = NodalVectors::Zero(3, body.body().node_count());
  body.set_velocities(1e-3 * models::random_vectors(static_cast<int>(none.cols()), 3));
  body.initialise_forces(none);
  const double start = body.kinetic_energy();
  double log_start = 0.0, log_end = 0.0;
  const int steps = 4000, window = 500;
  for (int n = 0; n < steps; ++n) {
    models::step(body, none);
    const double energy = body.kinetic_energy() + body.strain_energy();
    if (n < window) log_start += std::log(energy) / window;
    if (n >= steps - window) log_end += std::log(energy) / window;
    const structure::Work work = body.work();
    ASSERT_NEAR(body.kinetic_energy() + work.internal + work.damped, start, 1e-12 * start);
  }
  EXPECT_NEAR((log_start - log_end) / ((steps - window) * body.time_step()), rate, 2e-3 * rate);
}

TEST_P(MassDamping, GoesOnFromASavedStateToTheLastBit) {
  ExplicitSolver one = block(0.2, true, GetParam()), other = block(0.2, true, GetParam());
  const NodalVectors F = 1e-3 * models::random_vectors(one.body().node_count(), 8);
  one.initialise_forces(F);
  for (int n = 0; n < 20; ++n) models::step(one, F);
  other.load(one.save());
  other.initialise_forces(F);
  for (int n = 0; n < 20; ++n) models::step(one, F), models::step(other, F);
  EXPECT_EQ(one.save(), other.save());
}

// With momenta in the state or without.
TEST_P(MassDamping, BeginsAndEndsAtASavedState) {
  ExplicitSolver damped = block(0.2, true, GetParam()), free = block(0.0, true, GetParam());
  const NodalVectors F = 1e-3 * models::random_vectors(free.body().node_count(), 8);
  for (ExplicitSolver* one : {&free, &damped, &free}) {
    if (one->time() > 0.0 || one == &damped) one->load((one == &free ? damped : free).save());
    one->initialise_forces(F);
    for (int n = 0; n < 20; ++n) models::step(*one, F);
    EXPECT_EQ(one->work().damped > 0.0, one == &damped);
  }
  EXPECT_NEAR(free.time(), 60 * free.time_step(), 1e-12);
}

std::shared_ptr<const structure::Material> viscous(std::shared_ptr<const structure::Material> law, double b) {
  return std::make_shared<structure::Viscous>(std::move(law), b);
}

// S = b C : dE/dt of a law whose C is constant, and none under a rotation, of any law.
TEST(Viscosity, IsOfTheStrainAlone) {
  const structure::Matrix3 H = models::some_gradient(), I = structure::Matrix3::Identity(),
                           next = 1.1 * H + 0.01 * H.transpose();
  const structure::Matrix3 turn = Eigen::AngleAxisd(0.3, Vector3(1, -2, 2).normalized()).toRotationMatrix();
  const double b = 0.3, dt = 0.02;
  for (const auto& law : models::large_strain_laws()) {
    const auto damped = viscous(law, b);
    std::vector<double> old(19), now(19);
    damped->evolve(H, dt, std::vector<double>(19).data(), old.data());
    damped->evolve(turn * (I + H) - I, dt, old.data(), now.data());
    EXPECT_LT(structure::Matrix3::Map(now.data() + 9).norm(), 1e-9 * b / dt) << law->law();
    damped->evolve(next, dt, old.data(), now.data());
    const auto S = [&](const structure::Matrix3& G) {
      return structure::Matrix3((I + G).inverse() * law->stress(G, nullptr));
    };
    const structure::Matrix3 part = structure::Matrix3::Map(now.data() + 9);
    EXPECT_LT((part - part.transpose()).norm(), 1e-7 * part.norm()) << law->law();
    if (std::string(law->law()) != "neo_hooke") {
      EXPECT_LT((part - b / dt * (S(next) - S(H))).norm(), 1e-7 * part.norm()) << law->law();
    }
    EXPECT_LT((damped->stress(next, now.data()) - law->stress(next, nullptr) - (I + next) * part).norm(),
              1e-12);
  }
}

// The first longitudinal mode of a bar, omega = pi/2 c/L: its energy falls as exp(-b omega^2 t).
TEST(Viscosity, DampsAModeInProportionToItsFrequency) {
  const double pi = std::acos(-1.0), b = 0.02, omega = pi / 2;
  for (const std::shared_ptr<const structure::Material>& law :
       {models::elastic(1.0, 0.0), std::shared_ptr<const structure::Material>(
                                       std::make_shared<structure::SaintVenantKirchhoff>(1.0, 0.0, 1.0))}) {
    const nurbs::Volume patch = models::block({1, 0.1, 0.1}, {20, 1, 1}, {2, 1, 1});
    structure::Supports supports;
    supports.fix(structure::nodes_on(patch.space, {Face::xi_minus}), {true, false, false});
    structure::NodeSet all = structure::nodes_on(patch.space, {});
    supports.fix(all, {false, true, true});
    ExplicitSolver body(std::make_unique<structure::Solid>(patch, viscous(law, b)), supports);
    const double stable = body.stable_time_step(),
                 undamped = structure::stable_time_step(structure::Solid(patch, law), body.mass(), supports,
                                                        NodalVectors::Zero(3, body.body().node_count()));
    EXPECT_NEAR(stable, std::sqrt(undamped * undamped + b * b) - b, 1e-6 * stable);
    body.set_time_step(0.5 * stable);
    NodalVectors none = NodalVectors::Zero(3, body.body().node_count()), v = none;
    for (Eigen::Index A = 0; A < v.cols(); ++A) v(0, A) = 1e-5 * std::sin(omega * patch.control_points(0, A));
    body.set_velocities(v);
    body.initialise_forces(none);
    const double start = body.kinetic_energy();
    while (body.time() < 20.0) models::step(body, none);
    const double energy = body.kinetic_energy() + body.strain_energy();
    EXPECT_NEAR(std::log(start / energy) / body.time(), b * omega * omega, 0.02 * b * omega * omega);
    // A viscous stress is that of half a step before: b dt omega^2/2 of the energy.
    EXPECT_NEAR(body.work().damped, start - energy, 1e-3 * start) << "what is lost";
    EXPECT_NEAR(body.truncation(body.strain_energy()), 0.0, 1e-3 * start);
    EXPECT_NEAR(body.kinetic_energy() + body.work().internal + body.work().damped, start, 1e-12 * start);
  }
}

// A free block that spins: when it has come to rest in itself nothing is lost any more.
TEST(Viscosity, LetsABlockSpin) {
  const nurbs::Volume patch = models::block({2, 1, 1}, {2, 2, 2}, 2);
  ExplicitSolver body(
      std::make_unique<structure::Solid>(patch, viscous(models::large_strain_laws().front(), 0.5)), {});
  body.set_time_step(0.5 * body.stable_time_step());
  NodalVectors none = NodalVectors::Zero(3, body.body().node_count()), v = none;
  const Vector3 centre(1, 0.5, 0.5);
  for (Eigen::Index A = 0; A < v.cols(); ++A)
    v.col(A) = Vector3(0, 0, 0.05).cross(Vector3(patch.control_points.col(A)) - centre);
  body.set_velocities(v);
  body.initialise_forces(none);
  const double spin = body.angular_momentum(centre)[2];
  const auto energy = [&] { return body.kinetic_energy() + body.strain_energy(); };
  while (body.time() < 60.0) models::step(body, none);
  const double middle = energy();
  while (body.time() < 120.0) models::step(body, none);
  EXPECT_NEAR(energy() / middle, 1.0, 1e-5);
  EXPECT_NEAR(body.angular_momentum(centre)[2] / spin, 1.0, 1e-11);
  EXPECT_GT(body.displacements().norm(), 1.0) << "it has turned";
}

// What damps sub-steps takes vibrations from a spinning block, not its spin.
TEST(Lead, LetsABlockSpin) {
  constexpr double kLead = 0.05, kSpin = 0.05;
  const nurbs::Volume patch = models::block({2, 1, 1}, {2, 2, 2}, 2);
  ExplicitSolver body(std::make_unique<structure::Solid>(patch, models::large_strain_laws().front()), {});
  body.set_time_step(0.3 * body.stable_time_step());
  NodalVectors none = NodalVectors::Zero(3, body.body().node_count()), v = none;
  const Vector3 centre(1, 0.5, 0.5);
  for (Eigen::Index A = 0; A < v.cols(); ++A)
    v.col(A) = Vector3(0, 0, kSpin).cross(Vector3(patch.control_points.col(A)) - centre);
  body.set_velocities(v);
  body.set_lead(kLead);
  body.initialise_forces(none);
  const double spin = body.angular_momentum(centre)[2];
  while (body.time() < 60.0) {
    body.follow_spin();
    for (int n = 0; n < 4; ++n) models::step(body, none);
  }
  const double braked = kLead * kSpin * kSpin * body.time();
  EXPECT_NEAR(body.angular_momentum(centre)[2] / spin, 1.0, 1e-3 * braked);
}

// Of any heap of masses that moves as a rigid body.
TEST(Spin, IsThatOfARigidBody) {
  const NodalVectors x = models::random_vectors(40, 1);
  const Eigen::VectorXd masses = models::random_vectors(40, 2).row(0).cwiseAbs().array() + 0.1;
  const Vector3 omega(0.3, -0.7, 1.1), V(5, 6, -7);
  NodalVectors v = x;
  for (Eigen::Index A = 0; A < x.cols(); ++A) v.col(A) = V + omega.cross(Vector3(x.col(A)));
  EXPECT_LT((structure::spin(x, v, masses, structure::Halo()) - omega).norm(), 1e-12);
}

// A body that was put somewhere rests there, turned about or not, whatever its points remembered.
TEST(Viscosity, FeelsNothingOfWhereTheBodyWasPut) {
  const Eigen::Matrix3d half_a_turn = Eigen::AngleAxisd(EIGEN_PI, Vector3::UnitZ()).toRotationMatrix();
  for (const Eigen::Matrix3d& turn : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), half_a_turn}) {
    ExplicitSolver body(std::make_unique<structure::Solid>(models::block({2, 1, 1}, {4, 2, 2}, 2),
                                                           viscous(models::large_strain_laws().front(), 0.1)),
                        {});
    const Eigen::Matrix3d F = turn * (Eigen::Matrix3d::Identity() + 0.1 * models::some_gradient());
    const NodalVectors u = models::linear_field(F - Eigen::Matrix3d::Identity(), body.body().reference());
    NodalVectors rest(u), f(u);
    body.body().internal_force(u, rest);  // before points remember anything
    for (const double before : {0.0, 0.5}) {
      body.set_motion(before * u, NodalVectors::Zero(3, u.cols()), 0.0);
      body.settle();
    }
    body.set_motion(u, NodalVectors::Zero(3, u.cols()), 0.0);
    body.settle();
    body.body().internal_force(u, f);
    EXPECT_EQ(f, rest);
    EXPECT_EQ(body.body().dissipated_sum().value(), 0.0);
    body.set_time_step(1e-6);
    const NodalVectors hold = f;
    body.initialise_forces(hold);
    for (int n = 0; n < 3; ++n) models::step(body, hold);
    EXPECT_EQ(body.work().damped, 0.0);
  }
}

TEST(Viscosity, GoesOnFromASavedStateToTheLastBit) {
  const auto make = [] {
    ExplicitSolver body(std::make_unique<structure::Solid>(models::block({2, 1, 1}, {4, 2, 2}, 2),
                                                           viscous(models::large_strain_laws().front(), 0.1)),
                        {});
    body.set_time_step(0.5 * body.stable_time_step());
    return body;
  };
  ExplicitSolver one = make(), other = make();
  const NodalVectors F = 1e-3 * models::random_vectors(one.body().node_count(), 8);
  one.initialise_forces(F);
  for (int n = 0; n < 20; ++n) models::step(one, F);
  other.load(one.save());
  other.initialise_forces(F);
  for (int n = 0; n < 20; ++n) models::step(one, F), models::step(other, F);
  EXPECT_EQ(one.save(), other.save());
}

}  // namespace
