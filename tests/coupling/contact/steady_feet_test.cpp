// SPDX-License-Identifier: GPL-2.0-or-later
// Many balls that stay where they touch, as blocks of them are taken.
#include <gtest/gtest.h>

#include "balls.h"
#include "coupling/rigid/rigid_surface.h"
#include "walls.h"

namespace {

using coupling::RigidSurface;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;

constexpr double kDeep = 0.01;

/// The corner of a room, of triangles: x, y and z from 0 to 4.
RigidSurface corner() {
  nurbs::NodalVectors points(3, 7);
  points << 0, 4, 0, 0, 4, 4, 0,  //
      0, 0, 4, 0, 4, 0, 4,        //
      0, 0, 0, 4, 0, 4, 4;
  const std::vector<int> triangles = {0, 1, 4, 0, 4, 2, 0, 3, 5, 0, 5, 1, 0, 2, 6, 0, 6, 3};
  return test::wall_of(points, triangles);
}

// More of them than a block has lines for their feet: all have the forces of the first.
TEST(SteadyFeet, ManyBallsWithSeveralContacts) {
  const Vector3 overlap(kDeep, 2.0 * kDeep, 3.0 * kDeep);
  RigidSurface wall = corner();
  Balls balls(3, 1);
  for (int k = 0; k < 100; ++k) balls.add(Vector3::Constant(kRadius) - overlap, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1e-3);
  for (int step = 2; step <= 20; ++step) {
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), 300u);
    for (const contact::Contact& contact : scene.spring.seen) EXPECT_EQ(contact.history[0], step);
    EXPECT_LT((scene.balls.force(0) - overlap).norm(), 1e-12);
    for (int k = 1; k < 100; ++k) EXPECT_EQ(scene.balls.force(k), scene.balls.force(0)) << k;
  }
}

TEST(SteadyFeet, BallsThatLeaveTheGroupFeelNothing) {
  constexpr int kBalls = 70;
  RigidSurface wall = corner();
  Balls balls(1, 1);
  for (int k = 0; k < kBalls; ++k) balls.add({1.0 + 0.03 * k, 1.0, kRadius - kDeep}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1e-3);
  for (int step = 0; step < 20; ++step) {
    const auto is_away = [&](int k) { return 5 <= step && step < 10 && k % 3 == 0; };
    for (int k = 0; k < kBalls; ++k) scene.balls.mask[k] = is_away(k) ? 2 : 1;
    scene.evaluate();
    for (int k = 0; k < kBalls; ++k)
      EXPECT_NEAR(scene.balls.force(k)[2], is_away(k) ? 0.0 : kDeep, 1e-15) << step << ' ' << k;
  }
}

}  // namespace
