// SPDX-License-Identifier: GPL-2.0-or-later
// A step touches what is near the contacts, however large the wall is: all else is memory that ends the test
// with a segmentation fault.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "balls.h"
#include "coupling/rigid/rigid_surface.h"
#include "nurbs/guarded_columns.h"
#include "nurbs/primitives.h"
#include "rising_sheet.h"

namespace {

using nurbs::GuardedColumns;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;

constexpr int kElements = 128, kRows = 64;  // of size 1; the balls stay within few rows
constexpr Eigen::Index kFirst = kRows * (kElements + 2);
constexpr double kStiffness = 50.0, kOverlap = 0.1;

nurbs::Surface plane() {
  const auto knots = nurbs::KnotVector::uniform(2, kElements);
  return nurbs::plane({0, 0, 0}, {kElements, 0, 0}, {0, kElements, 0}, {knots, knots});
}

/// One well inside the plane, whose foot is followed, and one beside its edge, where all feet are sought
/// anew.
Balls balls() {
  Balls balls;
  balls.add({30.2, 6.3, kRadius - kOverlap}, kRadius);
  balls.add({50.6, 0.2, kRadius - kOverlap}, kRadius);
  return balls;
}

/// Steps of which none builds a list, each with two contacts.
void take_steps(BallsOnWall& scene, const std::vector<const nurbs::NodalVectors*>& arrays) {
  scene.step();  // the first knows where forces are
  std::vector<const nurbs::NodalVectors*> guarded = arrays;
  guarded.insert(guarded.end(),
                 {&scene.exchange().positions(), &scene.exchange().velocities(), &scene.forces->values});
  std::vector<std::unique_ptr<GuardedColumns>> guards;
  for (const nurbs::NodalVectors* array : guarded) {
    guards.push_back(std::make_unique<GuardedColumns>(*array, kFirst));
    ASSERT_GT(guards.back()->pages(), 40);
  }
  for (int step = 0; step < 5; ++step) {
    scene.step();
    ASSERT_EQ(scene.loop.contacts().size(), 2U);
    Vector3 on_wall = Vector3::Zero();
    for (const Eigen::Index A : scene.forces->touched) on_wall += scene.forces->values.col(A);
    EXPECT_EQ(scene.forces->touched.size(), 18U);
    EXPECT_LE((on_wall + scene.balls.force(0) + scene.balls.force(1)).norm(), 1e-12);
  }
}

// But for the largest motion, which is asked of the solver's own nodes.
TEST(UntouchedWall, OfOneThatDeforms) {
  constexpr double kStep = 1e-3, kSpeed = 1.0;
  test::RisingSheet sheet(plane(), kSpeed);
  BallsOnWall scene(sheet, balls(), kStiffness, kStep);
  take_steps(scene, {});
  EXPECT_NEAR(scene.loop.wall_motion(), 6 * kSpeed * kStep, 1e-14);
  EXPECT_NEAR(scene.loop.contacts()[0].overlap, kOverlap, 0.1 * kOverlap);
}

TEST(UntouchedWall, OfAServo) {
  constexpr double kStep = 1e-3, kTarget = 100.0;
  coupling::RigidDrive drive;
  drive.servo.emplace();
  drive.servo->controls = coupling::ServoSettings::Controls::force;
  drive.servo->com = {0, 0, 0};
  drive.servo->axis = {0, 0, 1};
  drive.servo->target = kTarget;
  drive.servo->vel_max = 0.5;
  drive.servo->kp = 1.0;
  coupling::RigidSurface wall({plane()});
  wall.drive(drive);
  BallsOnWall scene(wall, balls(), kStiffness, kStep);
  take_steps(scene, {&wall.positions(), &wall.velocities()});
  // up, so that the wall feels -target: at a speed in proportion to what is missing of it
  const double felt = -scene.balls.force(0)[2] - scene.balls.force(1)[2];
  wall.begin_step();
  EXPECT_NEAR(wall.frame().velocity[2], 0.5 * (kTarget + felt) / kTarget, 1e-12);
}

}  // namespace
