// SPDX-License-Identifier: GPL-2.0-or-later
// Balls whose centre passes the skin of a body: they stay on the side that they came from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../iga-solver/brep/cad_of_wall.h"
#include "balls.h"
#include "brep/builder.h"
#include "coupling/rigid/rigid_surface.h"

namespace {

using coupling::RigidSurface;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;

constexpr double kThickness = 0.1;

RigidSurface body_of(const brep::Surface& skin, bool as_patches, int outward) {
  brep::CadModel model = brep::trials::cad_of(skin, as_patches);
  model.solids.push_back({"body", -1, outward != 0});
  for (brep::CadFace& face : model.faces) face.solid = 0, face.outward = outward;
  std::vector<int> all(model.faces.size());
  std::iota(all.begin(), all.end(), 0);
  return RigidSurface(std::make_shared<brep::Surface>(brep::from_cad(model, all, 0.02)));
}

/// A sheet of 8 x 8 between z = -kThickness and z = 0.
RigidSurface thin_sheet(bool as_patches, int outward) {
  nurbs::NodalVectors points(3, 8);
  for (int k = 0; k < 8; ++k)
    points.col(k) << (k & 1 ? 4 : -4), (k & 2 ? 4 : -4), (k & 4 ? 0.0 : -kThickness);
  std::vector<int> triangles{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  if (outward < 0) std::reverse(triangles.begin(), triangles.end());  // normals into the body
  return body_of(brep::from_triangles(points, triangles), as_patches, outward);
}

/// Along y, of radius 2.
RigidSurface rod(bool as_patches) {
  brep::Face face;
  face.kind = brep::Kind::cylinder;
  face.frame = brep::frame_at({0, -4, 0}, Vector3::UnitY(), Vector3::UnitX());
  face.R = 2.0;
  face.high = {2.0 * M_PI, 8.0};
  return body_of(brep::from_faces({face}), as_patches, 1);
}

// Through the skin, through the far skin, and back: the force is that of the overlap with the side that the
// ball came from, in one contact that never ends, from above and from below.
TEST(DeepOverlap, InThinSheetComesOutWhereItWentIn) {
  constexpr double kStep = 0.01;
  for (const bool as_patches : {false, true})
    for (const int lists :
         {10, 17})  // steps between two: the centre passes the skin when one is new, and between two
      for (const double side : {1.0, -1.0}) {
        RigidSurface wall = thin_sheet(as_patches, 1);
        Balls balls(3, 1);
        const double skin = side > 0.0 ? 0.0 : -kThickness;
        double height = kRadius - kStep;
        balls.add({0.3, 0.1, skin + side * height}, kRadius);
        BallsOnWall scene(wall, balls, 1.0, 1.0);
        for (int step = 1; step <= 160; ++step) {
          height += step <= 80 ? -kStep : kStep;
          scene.balls.centre(0)[2] = skin + side * height;
          if (step % lists == 0) scene.build_list();
          scene.evaluate();
          ASSERT_EQ(scene.spring.seen.size(), 1u) << as_patches << ' ' << side << ' ' << height;
          const Vector3 expected(0.0, 0.0, side * (kRadius - height));
          EXPECT_LT((scene.balls.force(0) - expected).norm(), 1e-9)
              << as_patches << ' ' << side << ' ' << height;
          EXPECT_EQ(scene.spring.seen[0].history[0], step + 1) << height;
          EXPECT_EQ(scene.spring.seen[0].inside, height < -1e-9) << height;
        }
      }
}

// A centre that comes to be exactly on the skin is not behind it yet; the far skin, behind which it would be,
// pushes it no more than before.
TEST(DeepOverlap, ExactlyOnTheSkinItMeetsThatAlone) {
  for (const int outward : {1, -1})
    for (const double side : {1.0, -1.0}) {
      RigidSurface wall = thin_sheet(false, outward);
      Balls balls(3, 1);
      const double skin = side > 0.0 ? 0.0 : -kThickness;
      balls.add({0.3, 0.1, skin + 0.25 * side}, kRadius);
      BallsOnWall scene(wall, balls, 1.0, 1.0);
      for (const double height : {0.125, 0.0, -0.0625, 0.0, 0.125}) {
        scene.balls.centre(0)[2] = skin + side * height;
        scene.evaluate();
        ASSERT_EQ(scene.spring.seen.size(), 1u) << outward << ' ' << side << ' ' << height;
        EXPECT_NEAR(scene.balls.force(0)[2], side * (kRadius - height), 1e-8);
      }
    }
}

TEST(DeepOverlap, OnARodItRollsOnBehindTheSkin) {
  constexpr double kStep = 0.02;
  for (const bool as_patches : {false, true}) {
    RigidSurface wall = rod(as_patches);
    Balls balls(3, 1);
    balls.add({2.4, 0.1, 0.0}, kRadius);
    BallsOnWall scene(wall, balls, 1.0, 1.0);
    for (int step = 1; step <= 400; ++step) {
      const double distance = 2.0 + 0.4 * std::cos(step * kStep), angle = step * kStep;
      const Vector3 outward(std::cos(angle), 0.0, -std::sin(angle));
      scene.balls.centre(0) = distance * outward + Vector3(0.0, 0.1, 0.0);
      scene.build_list();
      scene.evaluate();
      ASSERT_EQ(scene.spring.seen.size(), 1u) << as_patches << ' ' << step;
      const Vector3 expected = (kRadius + 2.0 - distance) * outward;
      EXPECT_LT((scene.balls.force(0) - expected).norm(), 1e-11) << as_patches << ' ' << step;
      EXPECT_EQ(scene.spring.seen[0].history[0], step + 1) << as_patches << ' ' << step;
    }
  }
}

// A ball that lies inside of a body from the beginning has not touched its skin; farther in than it reaches a
// branch ends; without an outward side the far side pushes it on.
TEST(DeepOverlap, OnlyOfABranchAndOnlyAsFarAsItReaches) {
  RigidSurface wall = thin_sheet(false, 1);
  Balls balls(3, 1);
  balls.add({0.3, 0.1, -0.5 * kThickness}, kRadius);
  balls.add({0.3, 2.1, 0.4}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  EXPECT_EQ(scene.spring.seen.size(), 1u);
  EXPECT_EQ(scene.balls.force(0).norm(), 0.0);
  for (double z = 0.3; z > -0.45; z -= 0.1) {
    scene.balls.centre(1)[2] = z;
    scene.evaluate();
  }
  EXPECT_GT(scene.balls.force(1)[2], 0.8);
  scene.balls.centre(1)[2] = -1.01 * kRadius;
  scene.evaluate();
  EXPECT_LT(scene.balls.force(1)[2], 0.0);

  RigidSurface two_sided = thin_sheet(false, 0);
  BallsOnWall other(two_sided, balls, 1.0, 1.0);
  other.balls.centre(1)[2] = -kThickness - 0.05;
  other.evaluate();
  EXPECT_LT(other.balls.force(1)[2], 0.0);
}

}  // namespace
