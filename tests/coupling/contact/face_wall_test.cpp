// SPDX-License-Identifier: GPL-2.0-or-later
// Balls on walls of faces, edges and vertices, without a deck.
#include <gtest/gtest.h>

#include <cmath>

#include "balls.h"
#include "brep/face_shape.h"
#include "coupling/rigid/rigid_surface.h"
#include "nurbs/primitives.h"
#include "walls.h"

namespace {

using coupling::RigidSurface;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;
using test::wall_of;

/// Two strips along y that meet at x = 0: left of it z = 0, right of it z = slope x.
RigidSurface bent_sheet(double slope) {
  nurbs::NodalVectors points(3, 6);
  points << -4, 0, 4, -4, 0, 4,  //
      -4, -4, -4, 4, 4, 4,       //
      0, 0, 4 * slope, 0, 0, 4 * slope;
  return wall_of(points, {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4});
}
RigidSurface floor() { return bent_sheet(0.0); }

/// The same of two patches, in no closed form as points are moved within their planes.
RigidSurface bent_patches(double slope) {
  const nurbs::KnotVector knots = nurbs::KnotVector::uniform(2, 3);
  std::vector<nurbs::Surface> patches{nurbs::plane({-4, -4, 0}, {4, 0, 0}, {0, 8, 0}, {knots, knots}),
                                      nurbs::plane({0, -4, 0}, {4, 0, 4 * slope}, {0, 8, 0}, {knots, knots})};
  for (nurbs::Surface& patch : patches) patch.control_points(1, 2 + 2 * knots.control_point_count()) += 0.3;
  return wall_of(patches);
}

// m x'' = -k x for half a period, on the diagonal of two triangles.
TEST(FaceWall, ABallBouncesOffAPlane) {
  constexpr double kStiffness = 400.0, kSpeed = 1.0, kStep = 1e-4;
  RigidSurface wall = floor();
  Balls balls;
  balls.add({-2.0, 0.0, kRadius}, kRadius, {0.25, 0, -kSpeed});
  BallsOnWall scene(wall, balls, kStiffness, kStep);
  test::expect_half_an_oscillation(scene, kStiffness, kSpeed, kStep);
  EXPECT_EQ(scene.balls.velocity(0)[0], 0.25);
}

// Pressed in by 1e-3 r and moved across the edge, without friction: the force changes by no more than the
// stiffness times what the ball has moved, convex or concave, there is one contact on convex edges, and a
// contact that goes over a smooth edge keeps its slot, concave too.
void expect_no_jump(RigidSurface (*sheet)(double), std::initializer_list<double> angles) {
  constexpr double kOverlap = 1e-3, kStep = 1e-5;
  for (const double degrees : angles) {
    RigidSurface wall = sheet(std::tan(degrees * M_PI / 180.0));
    for (const double side : {1.0, -1.0}) {
      Balls balls(3, 1);
      balls.add({-0.3, 0.1, side * (kRadius - kOverlap)}, kRadius);
      BallsOnWall scene(wall, balls, 1.0, 1.0);
      Vector3 before = scene.balls.force(0);
      for (int step = 1; step <= 60000; ++step) {
        scene.balls.centre(0)[0] += kStep;
        scene.evaluate();
        const Vector3 force = scene.balls.force(0);
        const double jump = (force - before).norm();
        ASSERT_LT(jump, 3.0 * kStep) << degrees << ' ' << side << ' ' << step;
        if (degrees * side <= 0.0) {
          EXPECT_LE(scene.spring.seen.size(), 1u) << degrees << ' ' << side;
        }
        EXPECT_LE(scene.spring.seen.size(), 2u);
        if (std::abs(degrees) < 1.0 && !scene.spring.seen.empty()) {
          ASSERT_EQ(scene.spring.seen[0].history[0], step + 1) << degrees << ' ' << side;
        }
        before = force;
      }
    }
  }
}

TEST(FaceWall, RollsOverEdgesWithoutAJump) {
  expect_no_jump(bent_sheet, {-30.0, -5.0, -0.5, 0.0, 0.5, 5.0, 30.0});
}
TEST(FaceWall, RollsOverEdgesOfPatchesWithoutAJump) {
  expect_no_jump(bent_patches, {-30.0, -5.0, -2.0, 2.0, 5.0, 30.0});
}

// The rim of a floor presses against the centre once that is beyond it: spring times overlap, from the
// nearest point of two triangles that the ball is over one after the other.
TEST(FaceWall, RollsOffAFreeRim) {
  constexpr double kHeight = kRadius - 0.01, kStep = 1e-4;
  RigidSurface wall = floor();
  Balls balls(2, 1);
  balls.add({-0.3, 3.9, kHeight}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  for (int step = 1; step <= 1900; ++step) {
    scene.balls.centre(0)[1] += kStep;
    scene.evaluate();
    const Vector3 from_rim(0.0, std::max(scene.balls.centre(0)[1] - 4.0, 0.0), kHeight);
    const double overlap = std::max(kRadius - from_rim.norm(), 0.0);
    ASSERT_LT((scene.balls.force(0) - overlap * from_rim.normalized()).norm(), 1e-12) << step;
  }
}

// On triangles much smaller than the ball, which comes to others while its list still holds: one contact
// throughout, with the force of a plane.
TEST(FaceWall, GoesOnToOtherTriangles) {
  constexpr int kSquares = 40;
  constexpr double kSize = 0.02, kSmall = 0.1, kOverlap = 1e-3;
  nurbs::NodalVectors points(3, (kSquares + 1) * (kSquares + 1));
  std::vector<int> triangles;
  for (int j = 0; j <= kSquares; ++j)
    for (int i = 0; i <= kSquares; ++i) {
      const int a = i + (kSquares + 1) * j, b = a + kSquares + 1;
      points.col(a) = Vector3(kSize * i, kSize * j, 0.0);
      if (i < kSquares && j < kSquares) triangles.insert(triangles.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  RigidSurface wall = wall_of(points, triangles);
  Balls balls(2, 1);
  balls.add({0.3, 0.41, kSmall - kOverlap}, kSmall);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  for (int step = 1; step <= 112; ++step) {  // hardly at first, then half a skin
    scene.balls.centre(0)[0] += step <= 12 ? 1e-6 : 1e-3;
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), 1u) << step;
    EXPECT_NEAR(scene.balls.force(0)[2], kOverlap, 1e-12);
    EXPECT_EQ(scene.spring.seen[0].history[0], step + 1);
  }
}

// More balls than are taken together, each over a plate of its own: it has the overlap with that one, whoever
// comes before it in the list, those that touch nothing too.
TEST(FaceWall, EachOfManyIsOverItsOwnPlate) {
  constexpr int kPlates = 100, kFar = 7;
  constexpr double kOverlap = 1e-3, kSmall = 0.1, kApart = 0.15;
  const auto height = [](int k) { return 0.01 * (k % 9); };
  nurbs::NodalVectors points(3, 4 * kPlates);
  std::vector<int> triangles;
  for (int k = 0; k < kPlates; ++k) {
    const double x = kApart * k - 7.0, z = height(k);
    points.middleCols<4>(4 * k) << x, x + 0.1, x, x + 0.1, -1, -1, 1, 1, z, z, z, z;
    for (const int corner : {0, 1, 2, 1, 3, 2}) triangles.push_back(4 * k + corner);
  }
  RigidSurface wall = wall_of(points, triangles);
  Balls balls(2, 1);
  for (int k = 0; k < kFar; ++k) balls.add({0.0, 0.0, 5.0 + k}, kSmall);
  for (int k = 0; k < kPlates; ++k)
    balls.add({kApart * k - 6.95, -0.5, height(k) + kSmall - (1 + k) * kOverlap / kPlates}, kSmall);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  for (int step = 0; step < 20; ++step) {
    ASSERT_EQ(scene.spring.seen.size(), kPlates) << step;
    for (int k = 0; k < kPlates; ++k)
      ASSERT_NEAR(scene.balls.force(kFar + k)[2], (1 + k) * kOverlap / kPlates, 1e-12) << step << ' ' << k;
    scene.balls.centre(kFar + step)[1] += 0.3;
    scene.evaluate();
  }
}

// In a corner each side has a slot of its own: while the one lasts the other may end and begin anew.
TEST(FaceWall, BranchesKeepTheirSlots) {
  nurbs::NodalVectors points(3, 6);  // z = 0 for x > 0 and x = 0 for z > 0
  points << 4, 0, 0, 4, 0, 0,        //
      -4, -4, -4, 4, 4, 4,           //
      0, 0, 4, 0, 0, 4;
  RigidSurface wall = wall_of(points, {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4});
  Balls balls(2, 1);
  balls.add({0.45, 0.0, 0.45}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  const auto history_at = [&](int axis) {  // -1: no contact
    for (const contact::Contact& c : scene.spring.seen)
      if (c.delta[axis] > 0.4) return c.history[0];
    return -1.0;
  };
  for (int step = 1; step < 40; ++step) {
    const bool both = step < 10 || step >= 20;
    scene.balls.centre(0) = Vector3(both ? 0.45 : 0.55, 0.01 * step, both ? 0.45 : 0.46);
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), both ? 2u : 1u) << step;
    EXPECT_EQ(history_at(2), step + 1);
    EXPECT_EQ(history_at(0), step < 10 ? step + 1 : both ? step - 19 : -1);
  }
}

// The nodes of such a wall, four, have the force and the torque that act at the foot.
TEST(FaceWall, ForcesOnItsNodesAreThoseAtTheFoot) {
  RigidSurface wall = bent_sheet(0.3);
  coupling::SurfaceExchange exchange(MPI_COMM_SELF, wall);
  const Vector3 F(0.3, -2.0, 0.7);
  const coupling::ContactForce contact{1, 0, 1, {0.4, -1.7}, {F[0], F[1], F[2]}};
  const Vector3 x = wall.surface().faces->faces[1].point({0.4, -1.7});
  const coupling::NodalForces& forces = exchange.export_add({contact});
  Vector3 sum = Vector3::Zero(), torque = Vector3::Zero();
  for (int a = 0; a < 4; ++a) {
    const Vector3 f = forces.values.col(a);
    sum += f;
    torque += Vector3(wall.positions().col(a)).cross(f);
  }
  EXPECT_LT((sum - F).norm(), 1e-14);
  EXPECT_LT((torque - x.cross(F)).norm(), 1e-13);
}

// A floor that spans a periodic box has no rim there: one contact throughout, which keeps its slot, and the
// force is that of a floor without end.
TEST(FaceWall, GoesOnAcrossAPeriodicFace) {
  constexpr double kOverlap = 1e-3, kStep = 1e-3;
  RigidSurface wall = floor();
  Balls balls(2, 1);
  balls.add({3.5, 0.1, kRadius - kOverlap}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0, {{-4, -9, -9}, {4, 9, 9}, {true, false, false}});
  for (int step = 2; step <= 1000; ++step) {
    double& x = scene.balls.x[0];
    x += kStep;
    if (x > 4.0) x -= 8.0;
    if (step % 100 == 0 || x < -4.0 + kStep) scene.build_list();
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), 1u) << x;
    EXPECT_NEAR(scene.balls.force(0)[2], kOverlap, 1e-12) << x;
    EXPECT_EQ(scene.spring.seen[0].history[0], step) << x;
  }
}

// Rows are made when they are asked for, from what was so in the step: the wall feels the opposite of the
// spring at the foot, and gives the power of its motion there, whatever has moved since.
TEST(FaceWall, RowsReadLaterAreThoseOfTheStep) {
  constexpr double kStep = 1e-3;
  const Vector3 velocity(0.2, -0.1, 0.05), axis(0.6, 0, 0.8);
  RigidSurface wall = floor();
  wall.set_motions({coupling::linear(velocity), coupling::rotate({0, 0, 0}, axis, 40.0)});
  Balls balls;
  balls.add({0.7, -0.4, 0.9 * kRadius}, kRadius);
  balls.add({-2.1, 1.3, 0.95 * kRadius}, kRadius);
  BallsOnWall scene(wall, balls, 40.0, kStep);
  for (int step = 0; step < 20; ++step) scene.step();
  const coupling::RigidFrame frame = wall.frame();
  const std::vector<Vector3> centres = {scene.balls.centre(0), scene.balls.centre(1)},
                             forces = {scene.balls.force(0), scene.balls.force(1)};
  // A part of the next step.
  for (double& x : scene.balls.x) x += 0.3;
  wall.begin_step();
  scene.loop.wall().import();
  const std::vector<contact::WallContact>& rows = scene.loop.rows();
  ASSERT_EQ(rows.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const contact::WallContact& row = rows[k];
    const Vector3 point = Vector3::Map(row.point), F = Vector3::Map(row.force);
    EXPECT_EQ(row.tag, k + 1);
    EXPECT_EQ(row.slot, 0.0);
    const Vector3 n = frame.rotation.col(2);
    const double height = n.dot(centres[k] - frame.origin);
    EXPECT_LT((point - (centres[k] - height * n)).norm(), 1e-13);
    EXPECT_NEAR(row.overlap, kRadius - height, 1e-13);
    EXPECT_GT(std::abs(n[1]), 1e-3);
    EXPECT_EQ(F, -forces[k]);
    EXPECT_LT((Vector3::Map(row.torque) + centres[k].cross(forces[k])).norm(), 1e-13);
    const Vector3 v = frame.velocity + frame.angular_velocity.cross(point - frame.origin);
    EXPECT_NEAR(row.power, -F.dot(v), 1e-12);
    EXPECT_GT(std::abs(row.power), 1e-2);
  }
}

// Steady contacts have the parameters of their foot, in the contact and in the slot that keeps them.
TEST(FaceWall, SteadyContactsKnowWhereTheyAre) {
  RigidSurface wall = floor();
  Balls balls;
  balls.add({-2.0, 0.3, 0.99 * kRadius}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  for (int step = 0; step < 10; ++step) {
    scene.balls.centre(0) += Vector3(0.002, 0.001, 0.0);
    scene.evaluate();
    ASSERT_EQ(scene.loop.contacts().size(), 1u);
    const contact::Contact& contact = scene.loop.contacts()[0];
    const Vector3 point = scene.balls.centre(0) - Vector3(0, 0, 0.99 * kRadius);
    const nurbs::SurfacePoint kept = scene.balls.view().memory.slot(0, contact.slot).foot();
    EXPECT_EQ(kept.patch, contact.foot.patch);
    for (const nurbs::SurfacePoint& foot : {contact.foot, kept})
      EXPECT_LT((brep::point_on(*wall.surface().faces, foot.patch, foot.xi) - point).norm(), 1e-14) << step;
    EXPECT_LT((contact.centre - contact.delta - point).norm(), 1e-14);
    EXPECT_EQ(contact.effective_radius, kRadius);
  }
}

// Balls on two faces, in one block, within reach of both planes: spring times overlap along the normal of the
// face below.
TEST(FaceWall, SteadyContactsKnowTheirFaces) {
  constexpr double kSlope = -0.05, kHeight = 0.97 * kRadius, kStep = 1e-3;
  RigidSurface wall = bent_sheet(kSlope);
  const Vector3 flat = Vector3::UnitZ(), slanted = Vector3(-kSlope, 0, 1).normalized();
  Balls balls;
  for (int k = 0; k < 6; ++k) {
    const int row = k / 2;
    const double x = 1.0 + 0.4 * row, y = k - 2.5;
    balls.add(k % 2 == 0 ? Vector3(Vector3(-x, y, 0) + kHeight * flat)
                         : Vector3(Vector3(x, y, kSlope * x) + kHeight * slanted),
              kRadius);
  }
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  for (int step = 1; step <= 10; ++step) {
    for (int k = 0; k < 6; ++k) scene.balls.centre(k) += kStep * Vector3(0.1 * k, 1.0, 0.2);
    scene.evaluate();
    for (int k = 0; k < 6; ++k) {
      const Vector3& normal = k % 2 == 0 ? flat : slanted;
      const Vector3 force = (kRadius - normal.dot(scene.balls.centre(k))) * normal;
      EXPECT_LT((scene.balls.force(k) - force).norm(), 1e-14) << step << ' ' << k;
    }
  }
}

}  // namespace
