// SPDX-License-Identifier: GPL-2.0-or-later
// Poses and velocities of a moved rigid body against closed forms, and against nodes moved one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "../wavy_surface.h"
#include "coupling/rigid/rigid_motion.h"
#include "coupling/rigid/rigid_surface.h"

namespace {

using coupling::Motion;
using coupling::MovingFrame;
using coupling::RigidFrame;
using coupling::RigidMotion;
using coupling::Vector3;
using nurbs::kPi;

constexpr double kDt = 1e-3;
const Vector3 kCentre(0.3, -0.2, 0.5), kAxis(1.0, 2.0, -2.0), kPoint(0.7, 0.1, -0.4);

/// The body frame after so many steps.
RigidFrame after(int steps, std::vector<Motion> motions, double dt = kDt) {
  RigidMotion motion(std::move(motions));
  MovingFrame body;
  for (int n = 0; n < steps; ++n) motion.advance(body, dt);
  return body.frame();
}

/// sum_{k=1..n} cos(k theta) and sin(k theta), the closed forms of what backward Euler adds up.
double sum_of_cos(int n, double theta) {
  return std::sin(0.5 * n * theta) * std::cos(0.5 * (n + 1) * theta) / std::sin(0.5 * theta);
}
double sum_of_sin(int n, double theta) {
  return std::sin(0.5 * n * theta) * std::sin(0.5 * (n + 1) * theta) / std::sin(0.5 * theta);
}

/// Turned by `angle` about kAxis through kCentre, turning at `rate`.
void expect_turned(const RigidFrame& frame, double angle, double rate) {
  const Vector3 axis = kAxis.normalized();
  const Vector3 x = kCentre + Eigen::AngleAxisd(angle, axis) * (kPoint - kCentre);
  EXPECT_LE((frame.to_space(kPoint) - x).norm(), 1e-12);
  EXPECT_LE((frame.velocity_at(x) - rate * axis.cross(x - kCentre)).norm(), 1e-12 * std::abs(rate));
}

coupling::Harmonics two_harmonics() { return {{0.4, 0.1}, {1.3, -0.2}, {0.5, 0.17}}; }

/// Displacement that backward Euler makes of them in n steps.
double summed(const coupling::Harmonics& h, int n) {
  double sum = 0.0;
  for (std::size_t j = 0; j < h.amplitude.size(); ++j) {
    const double theta = 2 * kPi / h.period[j] * kDt;
    sum -= h.amplitude[j] * theta *
           (std::cos(h.phase[j]) * sum_of_sin(n, theta) + std::sin(h.phase[j]) * sum_of_cos(n, theta));
  }
  return sum;
}

TEST(RigidMotion, RestsUntilTheFirstStep) {
  const RigidFrame frame = after(0, {coupling::linear({1, 2, 3})});
  EXPECT_EQ(frame.to_space(kPoint), kPoint);
  EXPECT_EQ(frame.velocity_at(kPoint), Vector3::Zero());
}

TEST(RigidMotion, Linear) {
  const Vector3 V(0.1, -2.0, 0.5);
  const RigidFrame frame = after(700, {coupling::linear(V)});
  EXPECT_LE((frame.to_space(kPoint) - kPoint - 0.7 * V).norm(), 1e-12);
  EXPECT_EQ(frame.velocity_at(kPoint), V);
}

TEST(RigidMotion, LinearVariableAsksOncePerStep) {
  int asked = 0;
  const auto v = [&asked] { return 2.0 * ++asked; };  // 2, 4, 6, ...
  const RigidFrame frame = after(100, {coupling::linear_variable(0.5, coupling::Value(v), -1.0)});
  EXPECT_EQ(asked, 100);
  EXPECT_LE((frame.to_space(kPoint) - kPoint - kDt * Vector3(50, 10100, -100)).norm(), 1e-11);
  EXPECT_EQ(frame.velocity, Vector3(0.5, 200.0, -1.0));
}

TEST(RigidMotion, Wiggle) {
  const Vector3 A(0.0, 0.01, -0.02);
  const double period = 0.35, omega = 2 * kPi / period;
  const RigidFrame frame = after(512, {coupling::wiggle(A, period)});
  const Vector3 moved = frame.to_space(kPoint) - kPoint;
  EXPECT_LE((moved - A * omega * kDt * sum_of_cos(512, omega * kDt)).norm(), 1e-14);
  EXPECT_LE((moved - A * std::sin(omega * 0.512)).norm(), omega * kDt * A.norm()) << "first order";
  EXPECT_LE((frame.velocity - A * omega * std::cos(omega * 0.512)).norm(), 1e-13);
}

TEST(RigidMotion, Rotate) {
  const double omega = 2 * kPi / 2.5;
  expect_turned(after(900, {coupling::rotate(kCentre, kAxis, 2.5)}), 0.9 * omega, omega);
  expect_turned(after(900, {coupling::rotate(kCentre, kAxis, -2.5)}), -0.9 * omega, -omega);
}

TEST(RigidMotion, RotateVariable) {
  double rate = 0.0;
  const auto rising = [&rate] { return rate += 0.01; };
  expect_turned(after(300, {coupling::rotate_variable(kCentre, kAxis, coupling::Value(rising))}),
                kDt * 0.01 * 300 * 301 / 2, 3.0);
}

TEST(RigidMotion, Riggle) {
  const double omega = 2 * kPi / 0.3, amplitude = 25.0 * kPi / 180.0;
  expect_turned(after(400, {coupling::riggle(kCentre, kAxis, 0.3, 25.0)}),
                amplitude * omega * kDt * sum_of_cos(400, omega * kDt),
                amplitude * omega * std::cos(omega * 0.4));
}

TEST(RigidMotion, Viblin) {
  const coupling::Harmonics h = two_harmonics();
  const RigidFrame frame = after(333, {coupling::viblin(kAxis, h)});
  const Vector3 moved = frame.to_space(kPoint) - kPoint;
  EXPECT_LE((moved - summed(h, 333) * kAxis.normalized()).norm(), 1e-13);
  EXPECT_LE((frame.velocity - h.rate(0.333) * kAxis.normalized()).norm(), 1e-12);
}

TEST(RigidMotion, Vibrot) {
  const coupling::Harmonics h = two_harmonics();
  expect_turned(after(333, {coupling::vibrot(kCentre, kAxis, h)}), summed(h, 333), h.rate(0.333));
}

TEST(Harmonics, RateIsTheDerivative) {
  const coupling::Harmonics h = two_harmonics();
  const auto c = [&](double t) {
    double sum = 0.0;
    for (int j = 0; j < 2; ++j) sum += h.amplitude[j] * std::cos(2 * kPi * t / h.period[j] + h.phase[j]);
    return sum;
  };
  for (const double t : {0.0, 0.1, 0.27}) EXPECT_NEAR(h.rate(t), (c(t + 1e-6) - c(t - 1e-6)) / 2e-6, 1e-8);
}

/// One node and centres of rotation, moved by hand: what several fix move/mesh do to one mesh.
struct Node {
  Vector3 x = kPoint, v = Vector3::Zero();

  void translate(const Vector3& V) {
    x += kDt * V;
    v += V;
  }
  void turn(const Vector3& centre, const Vector3& axis, double rate) {
    x = centre + Eigen::AngleAxisd(rate * kDt, axis.normalized()) * (x - centre);
    v += rate * axis.normalized().cross(x - centre);
  }
};

TEST(RigidMotion, ARotationBeforeATranslationKeepsItsCentre) {
  const Vector3 V(0.3, 0.2, 0.1);
  const RigidFrame frame = after(400, {coupling::rotate(kCentre, kAxis, 1.5), coupling::linear(V)});
  Node node;
  for (int n = 0; n < 400; ++n) {
    node.v.setZero();
    node.turn(kCentre, kAxis, 2 * kPi / 1.5);
    node.translate(V);
  }
  EXPECT_LE((frame.to_space(kPoint) - node.x).norm(), 1e-12);
  EXPECT_LE((frame.velocity_at(node.x) - node.v).norm(), 1e-12);
}

TEST(RigidMotion, ARotationAfterATranslationGoesAlong) {
  const Vector3 V(0.3, 0.2, 0.1);
  const RigidFrame frame = after(400, {coupling::linear(V), coupling::rotate(kCentre, kAxis, 1.5)});
  expect_turned({frame.rotation, frame.origin - 0.4 * V, frame.velocity - V, frame.angular_velocity},
                0.4 * 2 * kPi / 1.5, 2 * kPi / 1.5);
}

// As in LIGGGHTS; its manual says otherwise.
TEST(RigidMotion, TheCentresOfRiggleAndVibrotStay) {
  const Vector3 V(0.3, 0.2, 0.1);
  const coupling::Harmonics h = two_harmonics();
  const double omega = 2 * kPi / 0.3, amplitude = 25.0 * kPi / 180.0;
  const RigidFrame frame = after(250, {coupling::linear(V), coupling::riggle(kCentre, kAxis, 0.3, 25.0),
                                       coupling::vibrot(kCentre, kAxis, h)});
  Node node;
  for (int n = 1; n <= 250; ++n) {
    node.v.setZero();
    node.translate(V);
    node.turn(kCentre, kAxis, amplitude * omega * std::cos(omega * n * kDt));
    node.turn(kCentre, kAxis, h.rate(n * kDt));
  }
  EXPECT_LE((frame.to_space(kPoint) - node.x).norm(), 1e-12);
}

// An epicycle: the second axis is carried round by the first rotation.
TEST(RigidMotion, ARotationCarriesTheCentreOfTheNext) {
  const Vector3 arm(0.2, 0.0, 0.0), other(0.0, 0.0, 1.0);
  const double slow = 2 * kPi / 2.0, fast = 2 * kPi / 0.5;
  const RigidFrame frame =
      after(500, {coupling::rotate(kCentre, kAxis, 2.0), coupling::rotate(kCentre + arm, other, 0.5)});
  Node node, centre;
  centre.x = kCentre + arm;
  for (int n = 0; n < 500; ++n) {
    node.v.setZero();
    node.turn(kCentre, kAxis, slow);
    centre.turn(kCentre, kAxis, slow);
    node.turn(centre.x, other, fast);
  }
  EXPECT_LE((frame.to_space(kPoint) - node.x).norm(), 1e-12);
  // The velocity of the body's origin is that of a node; elsewhere it differs from a node's by the angle that
  // the second rotation turns in one step.
  EXPECT_LE((frame.velocity_at(node.x) - node.v).norm(), slow * fast * kDt * kPoint.norm());
}

TEST(RigidMotion, VelocityIsThatOfTheMotion) {
  const std::vector<Motion> motions = {coupling::linear({0.1, 0, 0}), coupling::rotate(kCentre, kAxis, 1.0),
                                       coupling::wiggle({0, 0.01, 0}, 0.2)};
  for (const double dt : {1e-4, 1e-5}) {
    const int steps = static_cast<int>(std::lround(0.05 / dt));
    const RigidFrame before = after(steps, motions, dt), now = after(steps + 1, motions, dt);
    const Vector3 x = now.to_space(kPoint);
    EXPECT_LE(((x - before.to_space(kPoint)) / dt - now.velocity_at(x)).norm(), 40.0 * dt);
  }
}

TEST(RigidMotion, StaysRigidForAMillionSteps) {
  const RigidFrame frame = after(1000000, {coupling::rotate(kCentre, kAxis, 0.777)});
  EXPECT_LE((frame.rotation.transpose() * frame.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(frame.rotation.determinant(), 1.0, 1e-14);
  EXPECT_NEAR((frame.to_space(kPoint) - kCentre).norm(), (kPoint - kCentre).norm(), 1e-12);
  EXPECT_LE((frame.to_space(kCentre) - kCentre).norm(), 1e-12);
}

TEST(RigidFrame, BodyAndSpaceAreInverse) {
  const RigidFrame frame = after(123, {coupling::rotate(kCentre, kAxis, 1.0), coupling::linear({1, 2, 3})});
  EXPECT_LE((frame.to_body(frame.to_space(kPoint)) - kPoint).norm(), 1e-15);
}

TEST(RigidFrame, LargestDisplacementIsAtACorner) {
  const RigidFrame first = after(10, {coupling::linear({1, 2, 3})});
  const RigidFrame second = after(100, {coupling::rotate(kCentre, kAxis, 0.3), coupling::linear({1, 2, 3})});
  const search::Box box{{-0.1, -0.3, 0.2}, {0.5, 0.4, 0.9}};
  const double bound = second.max_displacement(first, box);
  std::srand(3);
  double largest = 0.0;
  for (int n = 0; n < 20000; ++n) {
    Vector3 s = 0.5 * (Vector3::Random() + Vector3::Ones());
    if (n % 2) s = s.array().round();
    const Vector3 X = box.low + s.cwiseProduct(box.high - box.low);
    largest = std::max(largest, (second.to_space(X) - first.to_space(X)).norm());
  }
  EXPECT_LE(largest, bound);
  EXPECT_NEAR(largest, bound, 1e-15);
}

TEST(RigidFrame, ABlownUpFrameHasNoFiniteDisplacement) {
  RigidFrame lost;
  lost.origin[1] = std::nan("");
  EXPECT_FALSE(std::isfinite(lost.max_displacement({}, {{0, 0, 0}, {1, 1, 1}})));
}

coupling::RigidSurface moved_surface(std::vector<Motion> motions) {
  coupling::RigidDrive drive;
  drive.motions = std::move(motions);
  coupling::RigidSurface surface({test::wavy_surface()});
  surface.drive(std::move(drive));
  surface.set_time_step(kDt);
  return surface;
}

const std::vector<Motion> kSeveral = {coupling::wiggle({0, 0, 0.1}, 0.2),
                                      coupling::rotate(kCentre, kAxis, 1.0), coupling::linear({1, 0, 0}),
                                      coupling::rotate(kPoint, {0, 0, 1}, 0.4)};

void expect_equal(const RigidFrame& a, const RigidFrame& b) {
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.angular_velocity, b.angular_velocity);
}

TEST(RigidSurface, RestartContinuesToTheLastBit) {
  coupling::RigidSurface whole = moved_surface(kSeveral), first = moved_surface(kSeveral);
  for (int n = 0; n < 157; ++n) {
    whole.begin_step();
    first.begin_step();
  }
  coupling::RigidSurface second = moved_surface(kSeveral);
  second.load(first.save());
  expect_equal(second.frame(), whole.frame());
  for (int n = 0; n < 200; ++n) {
    whole.begin_step();
    second.begin_step();
  }
  expect_equal(second.frame(), whole.frame());
}

TEST(RigidSurface, AnotherMotionStartsAnewFromTheSavedPose) {
  coupling::RigidSurface first = moved_surface(kSeveral);
  for (int n = 0; n < 50; ++n) first.begin_step();
  const Vector3 there = first.frame().to_space(kPoint);

  coupling::RigidSurface at_rest({test::wavy_surface()});
  at_rest.load(first.save());
  EXPECT_EQ(at_rest.frame().to_space(kPoint), there);

  coupling::RigidSurface wiggled = moved_surface({coupling::wiggle({0.1, 0, 0}, 0.2)});
  wiggled.load(at_rest.save());
  wiggled.begin_step();
  const double omega = 2 * kPi / 0.2;
  const Vector3 step(0.1 * omega * std::cos(omega * kDt) * kDt, 0, 0);
  EXPECT_LE((wiggled.frame().to_space(kPoint) - there - step).norm(), 1e-15);
}

TEST(RigidSurface, OnlyAStateOfARigidWallFits) {
  coupling::RigidSurface surface = moved_surface(kSeveral);
  EXPECT_NO_THROW(surface.load({})) << "saved by a wall at rest";
  std::vector<double> state = surface.save();
  state.pop_back();
  EXPECT_THROW(surface.load(state), std::invalid_argument);
  EXPECT_THROW(surface.load(std::vector<double>(5, 0.0)), std::invalid_argument);
}

TEST(RigidSurface, AWallAtRestAsksForNothing) {
  const coupling::RigidSurface surface({test::wavy_surface()});
  EXPECT_FALSE(surface.moves());
  EXPECT_FALSE(surface.needs_forces());
  EXPECT_TRUE(surface.save().empty());
}

}  // namespace
