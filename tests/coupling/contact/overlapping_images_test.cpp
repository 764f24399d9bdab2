// SPDX-License-Identifier: GPL-2.0-or-later
// Walls that are longer than a periodic box, so that their images lie on themselves, or beside.
#include <gtest/gtest.h>

#include <cmath>

#include "balls.h"
#include "brep/builder.h"
#include "brep/faced_patches.h"
#include "coupling/rigid/rigid_surface.h"
#include "nurbs/primitives.h"

namespace {

using coupling::RigidSurface;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;

constexpr double kPressed = 1e-3, kRise = 0.02;
const contact::PeriodicBox kShortBox{{-3, -9, -9}, {3, 9, 9}, {true, false, false}};

/// A strip from x = -4 to 4 that rises by `slope`, and at its end, if that is above 0, a wall of this height.
RigidSurface long_strip(double slope, double height) {
  nurbs::NodalVectors points(3, 6);
  points << -4, 4, 4, -4, 4, 4,  //
      -4, -4, -4, 4, 4, 4,       //
      -4 * slope, 4 * slope, 4 * slope + height, -4 * slope, 4 * slope, 4 * slope + height;
  const std::vector<int> floor{0, 1, 3, 1, 4, 3}, both{0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4};
  if (height == 0.0) points.col(2) = points.col(1), points.col(5) = points.col(4);
  return RigidSurface(
      std::make_shared<brep::Surface>(brep::from_triangles(points, height > 0.0 ? both : floor)));
}

/// About the x axis, from x = -4 to 4.
RigidSurface long_pipe(double radius) {
  const std::vector<nurbs::Surface> patches{nurbs::cylinder(nurbs::frame({-4, 0, 0}, {1, 0, 0}), radius, 8.0,
                                                            nurbs::arc(0.0, 360.0),
                                                            nurbs::KnotVector::uniform(1, 1))};
  brep::FacedPatches faced = brep::closed_forms(patches, brep::kEdgeAngle).value();
  return RigidSurface(patches, {}, std::make_shared<brep::FacedPatches>(std::move(faced)));
}

/// Moved along a wall that goes on for ever, over all rims of its images: one contact, which keeps its slot.
void expect_no_end(RigidSurface& wall, const Vector3& from, double force, const Vector3& along) {
  constexpr double kStep = 2e-3;
  Balls balls(2, 1);
  balls.add(from, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox);
  for (int step = 2; step <= 4000; ++step) {
    Eigen::Map<Vector3> centre = scene.balls.centre(0);
    centre += kStep * along;
    if (centre[0] > 3.0) centre[0] -= 6.0;
    if (step % 50 == 0 || centre[0] < -3.0 + kStep) scene.build_list();
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), 1u) << centre[0];
    EXPECT_NEAR(scene.balls.force(0).norm(), force, 1e-12) << centre[0];
    EXPECT_EQ(scene.spring.seen[0].history[0], step) << centre[0];
  }
}

TEST(OverlappingImages, OfAPlaneAddNothing) {
  RigidSurface wall = long_strip(0.0, 0.0);
  expect_no_end(wall, {0.1, 0.1, kRadius - kPressed}, kPressed, Vector3(1, 0.2, 0).normalized());
}

TEST(OverlappingImages, OfAPipeAddNothing) {
  RigidSurface wall = long_pipe(2.0);
  expect_no_end(wall, {0.1, 2.0 - kRadius + kPressed, 0.0}, kPressed, Vector3::UnitX());
}

// Of two that lie one above the other a ball feels both.
TEST(OverlappingImages, OfASlopeCountBesideIt) {
  RigidSurface wall = long_strip(kRise, 0.0);
  Balls balls(3, 1);
  const double up = 1.0 / std::hypot(1.0, kRise), below = 6.0 * kRise * up;
  balls.add(Vector3(2.5, 0.0, 2.5 * kRise) + (kRadius - 0.2) * up * Vector3(-kRise, 0, 1), kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox);
  for (int step = 0; step < 5; ++step) {
    ASSERT_EQ(scene.spring.seen.size(), 2u);
    EXPECT_NEAR(scene.balls.force(0).norm(), 0.2 + (0.2 - below), 1e-12);
    scene.evaluate();
  }
}

// What stands on the end of the floor stands in the box, too.
TEST(OverlappingImages, OfAWallOnTheFloorStandThere) {
  RigidSurface wall = long_strip(0.0, 2.0);
  Balls balls(3, 1);
  balls.add({-2.0 - kRadius + 0.1, 0.3, kRadius - kPressed}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, kShortBox);
  for (int step = 0; step < 5; ++step) {
    ASSERT_EQ(scene.spring.seen.size(), 2u);
    EXPECT_LT((scene.balls.force(0) - Vector3(-0.1, 0, kPressed)).norm(), 1e-12);
    scene.evaluate();
  }
}

}  // namespace
