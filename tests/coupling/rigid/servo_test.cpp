// SPDX-License-Identifier: GPL-2.0-or-later
// The servo's controller against closed forms, and surfaces that slide within themselves.
#include <gtest/gtest.h>

#include <cmath>

#include "../wavy_surface.h"
#include "coupling/rigid/rigid_surface.h"

namespace {

using coupling::BeltVelocity;
using coupling::NodalForces;
using coupling::NodalVectors;
using coupling::RigidDrive;
using coupling::RigidSurface;
using coupling::RollerVelocity;
using coupling::ServoSettings;
using coupling::SlidingSurface;
using coupling::Value;
using coupling::Vector3;

constexpr double kServoStep = 1e-3, kStiffness = 2000.0, kTarget = -10.0;
const Vector3 kCom(0.1, 0.2, 0.3);

/// Presses down along z with 10 N.
ServoSettings press() {
  ServoSettings settings;
  settings.controls = ServoSettings::Controls::force;
  settings.com = kCom;
  settings.axis = {0, 0, 1};
  settings.target = kTarget;
  settings.vel_max = 0.1;
  settings.kp = 0.5;
  return settings;
}

RigidSurface surface_with(ServoSettings settings) {
  RigidDrive drive;
  drive.servo = std::move(settings);
  RigidSurface surface({test::wavy_surface()});
  surface.drive(std::move(drive));
  surface.set_time_step(kServoStep);
  surface.begin_run();
  return surface;
}

/// A wall that presses, after a restart in which it had been turned.
RigidSurface turned_wall(ServoSettings settings) {
  RigidDrive turn;
  turn.motions = {coupling::rotate({0, 0, 0}, {1, 1, 0}, 1.0)};
  RigidSurface before({test::wavy_surface()});
  before.drive(turn);
  before.set_time_step(0.1);
  before.begin_step();
  RigidSurface surface = surface_with(std::move(settings));
  surface.load(before.save());
  return surface;
}

/// Force F at control point a.
NodalForces force_at(const RigidSurface& surface, int a, const Vector3& F) {
  NodalVectors forces = NodalVectors::Zero(3, surface.positions().cols());
  forces.col(a) = F;
  return NodalForces(forces);
}

/// A spring below the wall pushes back; returns its force after so many steps.
double pressed_spring(RigidSurface& surface, int steps) {
  double push = 0.0;
  for (int n = 0; n < steps; ++n) {
    surface.begin_step();
    push = std::max(0.0, -kStiffness * surface.frame().origin.z());
    surface.end_step(force_at(surface, 3, {0.2, -0.1, push}));
  }
  return push;
}

// Backward Euler of v = -vel_max kp (target - F) / |target| on a spring: the error shrinks by the same factor
// each step.
TEST(Servo, ProportionalControlDecaysGeometrically) {
  RigidSurface surface = surface_with(press());
  const double factor = 1.0 - 0.1 * 0.5 * kStiffness * kServoStep / 10.0;
  for (int n = 0; n < 300; n += 50) {
    const double push = pressed_spring(surface, 50);
    // the first step moves nothing: no force has been seen yet
    EXPECT_NEAR(push, 10.0 * (1.0 - std::pow(factor, n + 49)), 1e-11);
  }
  EXPECT_LT(surface.frame().origin.z(), 0.0) << "a negative target drives the wall against the axis";
}

TEST(Servo, SettlesToItsForceWithAllThreeGains) {
  ServoSettings settings = press();
  settings.ki = 20.0;
  settings.kd = 1e-4;
  RigidSurface surface = surface_with(settings);
  EXPECT_NEAR(pressed_spring(surface, 8000), 10.0, 1e-10);
}

TEST(Servo, PositiveTargetDrivesTheOtherWay) {
  for (const double ki : {0.0, 20.0}) {
    ServoSettings settings = press();
    settings.target = 10.0;
    settings.ki = ki;
    settings.kp = 5.0;  // saturates at first
    RigidSurface surface = surface_with(settings);
    double push = 0.0;
    for (int n = 0; n < 8000; ++n) {
      surface.begin_step();
      push = std::max(0.0, kStiffness * surface.frame().origin.z());
      surface.end_step(force_at(surface, 3, {0, 0, -push}));
    }
    EXPECT_NEAR(push, 10.0, 1e-9);
  }
}

TEST(Servo, NeverFasterThanVelMax) {
  ServoSettings settings = press();
  settings.kp = 1000.0;
  settings.ki = 5.0;
  RigidSurface surface = surface_with(settings);
  surface.begin_step();
  surface.end_step(force_at(surface, 0, Vector3::Zero()));
  surface.begin_step();
  EXPECT_EQ(surface.frame().velocity, Vector3(0, 0, -0.1));
  EXPECT_EQ(surface.frame().origin, Vector3(0, 0, -0.1 * kServoStep));
}

// A wall that waits a second for its particles must not push for another second once it has its force.
TEST(Servo, TheIntegralDoesNotWindUp) {
  ServoSettings settings = press();
  settings.ki = 50.0;
  RigidSurface surface = surface_with(settings);
  const NodalForces none = force_at(surface, 0, Vector3::Zero());
  for (int n = 0; n < 1000; ++n) {
    surface.begin_step();
    surface.end_step(none);
  }
  EXPECT_EQ(surface.frame().velocity.z(), -0.1);
  // kp (e - e_0) is all that is left of the integral: at a force above the target the wall turns back at once
  surface.begin_step();
  surface.end_step(force_at(surface, 3, {0, 0, 40.0}));
  surface.begin_step();
  EXPECT_GT(surface.frame().velocity.z(), 0.0);
}

TEST(Servo, TheDerivativeIsThatOfTheForce) {
  ServoSettings settings = press();
  settings.kp = 0.0;
  settings.kd = 2e-5;
  double target = kTarget;
  settings.target = Value([&target] { return target; });
  RigidSurface surface = surface_with(settings);
  const auto velocity_after = [&surface](double force) {
    surface.begin_step();
    surface.end_step(force_at(surface, 3, {0, 0, force}));
    surface.begin_step();
    surface.end_step(force_at(surface, 3, {0, 0, force}));
    return surface.frame().velocity.z();
  };
  EXPECT_NEAR(velocity_after(4.0), 0.1 * 2e-5 * 4.0 / kServoStep / 10.0, 1e-15);
  target = -100.0;
  EXPECT_EQ(velocity_after(4.0), 0.0) << "a jump of the target alone moves nothing";
}

// A servo that stands knows the force all the same, so that it does not see a jump when it goes on.
TEST(Servo, GoesOnWithoutAJump) {
  ServoSettings settings = press();
  settings.kp = 0.0;
  settings.kd = 2e-5;
  RigidSurface surface = surface_with(settings);
  const auto step = [&surface](double force) {
    surface.begin_step();
    surface.end_step(force_at(surface, 3, {0, 0, force}));
    return surface.frame().velocity.z();
  };
  for (int n = 0; n < 3; ++n) step(4.0);
  surface.servo()->settings().integrate = false;
  for (const double force : {5.0, 9.0, 20.0}) EXPECT_EQ(step(force), 0.0);
  surface.servo()->settings().integrate = true;
  for (int n = 0; n < 3; ++n) EXPECT_EQ(step(20.0), 0.0) << n;
}

TEST(Servo, TorqueIsThatAboutTheCom) {
  ServoSettings settings = press();
  settings.controls = ServoSettings::Controls::torque;
  settings.axis = {0, 0, 1};
  settings.target = -2.0;
  RigidSurface surface = surface_with(settings);
  const Vector3 F(3.0, -1.0, 5.0);
  const double torque = (Vector3(surface.positions().col(7)) - kCom).cross(F).z();
  double lever = 0.0;
  for (int a = 0; a < surface.positions().cols(); ++a) {
    const Vector3 arm = Vector3(surface.positions().col(a)) - kCom;
    lever = std::max(lever, std::hypot(arm.x(), arm.y()));
  }
  surface.begin_step();
  surface.end_step(force_at(surface, 7, F));
  surface.begin_step();
  const double omega = -(0.1 / lever) * 0.5 * (2.0 - torque) / 2.0;
  ASSERT_LT(std::abs(omega), 0.1 / lever) << "not saturated";
  EXPECT_NEAR(surface.frame().angular_velocity.z(), omega, 1e-14);
  EXPECT_LE((surface.frame().to_space(kCom) - kCom).norm(), 1e-16) << "turns about the com";
  const Vector3 x = surface.frame().to_space(surface.positions().col(7));
  EXPECT_NEAR(std::atan2(x.y() - kCom.y(), x.x() - kCom.x()) -
                  std::atan2(surface.positions()(1, 7) - kCom.y(), surface.positions()(0, 7) - kCom.x()),
              omega * kServoStep, 1e-14);

  // forces are given in the body frame, in which this one has the same torque wherever the wall has turned
  for (int n = 0; n < 1000; ++n) {
    surface.end_step(force_at(surface, 7, F));
    surface.begin_step();
  }
  ASSERT_GT(std::abs(omega) * 1000 * kServoStep, 0.01);
  EXPECT_NEAR(surface.frame().angular_velocity.z(), omega, 1e-14);
}

TEST(Servo, ForceIsTurnedIntoSpace) {
  RigidSurface turned = turned_wall(press());
  const Vector3 F(3.0, -1.0, 5.0);
  const double value = (turned.frame().rotation * F).z();
  ASSERT_GT(std::abs(value - F.z()), 0.1);
  turned.end_step(force_at(turned, 2, F));
  turned.begin_step();
  EXPECT_NEAR(turned.frame().velocity.z(), -0.1 * 0.5 * (10.0 - value) / 10.0, 1e-15);
}

TEST(Servo, TorqueIsTurnedIntoSpace) {
  ServoSettings settings = press();
  settings.controls = ServoSettings::Controls::torque;
  RigidSurface turned = turned_wall(settings), straight = surface_with(settings);
  const Vector3 F(3.0, -1.0, 5.0), x = turned.frame().to_space(turned.positions().col(7));
  const double torque = (x - kCom).cross(turned.frame().rotation * F).z();
  turned.end_step(force_at(turned, 7, F));
  turned.begin_step();
  // the same torque on a wall that has not been turned, from a couple
  NodalVectors couple = NodalVectors::Zero(3, straight.positions().cols());
  const Vector3 arm = straight.positions().col(1) - straight.positions().col(0);
  const Vector3 f = torque * Vector3::UnitZ().cross(arm) / Vector3::UnitZ().cross(arm).squaredNorm();
  couple.col(1) = f;
  couple.col(0) = -f;
  straight.end_step(NodalForces(couple));
  straight.begin_step();
  EXPECT_NEAR(turned.frame().angular_velocity.z(), straight.frame().angular_velocity.z(), 1e-14);
  EXPECT_GT(std::abs(straight.frame().angular_velocity.z()), 1e-4);
}

TEST(Servo, AutomaticModeIsFastAloneAndSlowNearParticles) {
  long near = 0;
  ServoSettings settings = press();
  settings.automatic = {0.01, [] { return 2e-3; }, [&near] { return near; }};
  RigidSurface surface = surface_with(settings);
  const double slow = 0.01 * 2e-3 / kServoStep;
  const auto velocity_after = [&](long particles, double force) {
    near = particles;
    surface.begin_step();
    surface.end_step(force_at(surface, 3, {0, 0, force}));
    surface.begin_step();
    return surface.frame().velocity.z();
  };
  EXPECT_DOUBLE_EQ(velocity_after(0, 0.0), -0.1);
  EXPECT_DOUBLE_EQ(velocity_after(5, 0.0), -slow);
  EXPECT_NEAR(velocity_after(5, 0.5), -slow * (0.1 + 0.9 * 0.5) * 0.95, 1e-15) << "between 0.9 and 1";
  EXPECT_DOUBLE_EQ(velocity_after(5, 5.0), -slow * 0.1 * 0.5);
  EXPECT_DOUBLE_EQ(velocity_after(5, 15.0), slow * 0.1 * 0.5);
}

TEST(Servo, TargetZeroIsAnError) {
  ServoSettings settings = press();
  settings.target = Value([] { return 0.0; });
  RigidSurface surface = surface_with(settings);
  surface.begin_step();
  EXPECT_THROW(surface.end_step(force_at(surface, 0, Vector3::Zero())), std::invalid_argument);
}

TEST(Servo, AWallOnItsAxisCannotBeTurned) {
  nurbs::Surface thread = test::wavy_surface();
  thread.control_points.colwise() = kCom;
  RigidDrive drive;
  drive.servo = press();
  drive.servo->controls = ServoSettings::Controls::torque;
  RigidSurface surface({thread});
  EXPECT_THROW(surface.drive(drive), std::invalid_argument);
}

TEST(Servo, RestartContinuesToTheLastBit) {
  ServoSettings settings = press();
  settings.ki = 20.0;
  settings.kd = 1e-4;
  RigidSurface whole = surface_with(settings), first = surface_with(settings);
  pressed_spring(whole, 40);
  pressed_spring(first, 40);
  RigidSurface second = surface_with(settings);
  second.load(first.save());
  pressed_spring(whole, 50);
  pressed_spring(second, 50);
  EXPECT_EQ(second.frame().origin, whole.frame().origin);
  EXPECT_EQ(second.frame().velocity, whole.frame().velocity);
  EXPECT_LE((second.probes()[0].displacement - whole.frame().origin).norm(), 1e-15) << "the com goes along";
}

TEST(SlidingSurface, ABeltKeepsItsSpeedRoundABend) {
  const SlidingSurface belt(BeltVelocity{{3.0, 0.0, 4.0}});
  EXPECT_FALSE(belt.varies());
  for (const double angle : {0.0, 0.4, 1.1, 2.0}) {
    const Vector3 normal(std::sin(angle), 0, std::cos(angle));
    const Vector3 v = belt.velocity({1, 2, 3}, normal);
    EXPECT_NEAR(v.norm(), 5.0, 1e-14);
    EXPECT_NEAR(v.dot(normal), 0.0, 1e-14);
    EXPECT_GT(v.dot(Vector3(3, 0, 4)), 0.0);
    EXPECT_LE((v - belt.velocity({1, 2, 3}, -normal)).norm(), 1e-15);
  }
}

TEST(SlidingSurface, RestsWhereItsVelocityIsNormal) {
  const Vector3 normal = Vector3(1, 2, 3).normalized();
  EXPECT_EQ(SlidingSurface(BeltVelocity{{1.0, 2.0, 3.0}}).velocity({0, 0, 0}, normal), Vector3::Zero());
}

TEST(SlidingSurface, ARollerTurnsByTheRightHand) {
  const SlidingSurface roller(RollerVelocity{{1, 0, 0}, {0, 0, 2}, 3.0});
  const Vector3 v = roller.velocity({1.5, 0, 7}, {1, 0, 0});
  EXPECT_LE((v - Vector3(0, 1.5, 0)).norm(), 1e-15);
}

TEST(SlidingSurface, VariablesHoldUntilTheNextUpdate) {
  double speed = 1.0;
  RigidDrive drive;
  drive.sliding = SlidingSurface(BeltVelocity{{Value([&speed] { return speed; }), 0.0, 0.0}});
  RigidSurface surface({test::wavy_surface()});
  surface.drive(std::move(drive));
  EXPECT_TRUE(surface.moves()) << "so that begin_step is called";
  surface.begin_run();
  speed = 2.0;
  EXPECT_EQ(surface.surface_velocity({0, 0, 0}, {0, 0, 1}), Vector3(1, 0, 0));
  surface.begin_step();
  EXPECT_EQ(surface.surface_velocity({0, 0, 0}, {0, 0, 1}), Vector3(2, 0, 0));
  EXPECT_EQ(surface.frame().velocity, Vector3::Zero());
}

}  // namespace
