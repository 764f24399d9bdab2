// SPDX-License-Identifier: GPL-2.0-or-later
// Many balls that stay where they touch, as blocks of them are taken, and others that go on after a while.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "balls.h"
#include "brep/builder.h"
#include "brep/face_shape.h"
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

/// Triangles between points of a grid, every other one of them `depth` lower than its neighbours, about.
brep::Surface pits(std::mt19937& random, int squares, double size, double depth) {
  std::uniform_real_distribution<double> up(-0.1 * depth, 0.1 * depth);
  nurbs::NodalVectors points(3, (squares + 1) * (squares + 1));
  std::vector<int> triangles;
  for (int j = 0; j <= squares; ++j)
    for (int i = 0; i <= squares; ++i) {
      const int a = i + (squares + 1) * j, b = a + squares + 1;
      points.col(a) = Vector3(size * i, size * j, up(random) - ((i + j) % 2 == 0 ? depth : 0.0));
      if (i < squares && j < squares) triangles.insert(triangles.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  return brep::from_triangles(points, triangles);
}

/// Feet of a ball as a search among all pieces finds them, the nearest first.
std::vector<brep::Foot> feet_by_search(const brep::FootSearch& search, const Vector3& centre,
                                       double reach = kRadius) {
  std::vector<int> all(search.surface().pieces.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<brep::Foot> feet;
  search.feet(centre, reach, all.data(), static_cast<int>(all.size()), feet);
  return feet;
}

/// Of a ball on springs at all of these.
Vector3 force_by_search(const brep::FootSearch& search, const Vector3& centre) {
  Vector3 force = Vector3::Zero();
  for (const brep::Foot& foot : feet_by_search(search, centre))
    force += (kRadius - foot.distance) / foot.distance * (centre - foot.point);
  return force;
}

struct BallsThatDrift {
  Balls balls{8, 1};
  std::vector<Vector3> velocities;  // per step
};

/// Balls in steps in which they touch three faces or more, and in which they touch an edge.
struct Touching {
  int three = 0, edges = 0;
};

/// Whoever rests on its contacts for some steps and then goes on has the force, to the last digit, of who
/// looks for all feet in each step, the nearest first.
Touching expect_forces_of_a_search(const brep::Surface& surface, const BallsThatDrift& drifting) {
  const brep::FootSearch search(surface);
  RigidSurface wall(std::make_shared<brep::Surface>(surface));
  BallsOnWall scene(wall, drifting.balls, 1.0, 1.0);
  Touching touching;
  for (int step = 1; step <= 300; ++step) {
    for (int k = 0; k < scene.balls.count(); ++k) {
      scene.balls.velocity(k) = drifting.velocities[k];
      scene.balls.centre(k) += drifting.velocities[k];
    }
    if (step % 100 == 0) scene.build_list();
    scene.evaluate();
    size_t feet = 0;
    for (int k = 0; k < scene.balls.count(); ++k) {
      if (scene.balls.force(k) != force_by_search(search, scene.balls.centre(k)))
        ADD_FAILURE() << step << ' ' << k;
      const std::vector<brep::Foot> of_ball = feet_by_search(search, scene.balls.centre(k));
      feet += of_ball.size();
      touching.three += of_ball.size() > 2;
      touching.edges += std::any_of(of_ball.begin(), of_ball.end(), [](const brep::Foot& foot) {
        return foot.status == search::FootStatus::edge;
      });
    }
    const std::vector<contact::Contact>& seen = scene.spring.seen;
    EXPECT_EQ(seen.size(), feet) << step;
    const double off_plane = 2e-6 * surface.size;  // of triangles that are joined
    for (const contact::Contact& contact : seen) {
      const Vector3 foot = contact.centre - contact.delta;
      EXPECT_LT((brep::point_on(surface, contact.foot.patch, contact.foot.xi) - foot).norm(), off_plane)
          << step;
    }
    for (size_t n = 1; n < seen.size(); ++n)
      EXPECT_TRUE(seen[n - 1].particle != seen[n].particle || seen[n - 1].distance <= seen[n].distance)
          << step;
    if (testing::Test::HasFailure()) break;
  }
  return touching;
}

Vector3 slow(std::mt19937& random) {
  std::uniform_real_distribution<double> way(-1.0, 1.0);
  return std::pow(10.0, 2.0 * way(random) - 5.1) * Vector3(way(random), way(random), way(random));
}

/// In pits most balls touch several faces.
Touching in_pits(double depth) {
  std::mt19937 random(5);
  const brep::Surface surface = pits(random, 12, 0.5, depth);
  std::uniform_int_distribution<int> pit(2, 10);
  std::uniform_real_distribution<double> off(-0.03, 0.03);
  BallsThatDrift drifting;
  for (int k = 0; k < 300; ++k) {
    const int i = pit(random), j = i % 2 + 2 * (pit(random) / 2);
    const double aside = k % 2 == 0 ? 1.0 : 0.1;
    const double overlap = 0.05 * depth + 0.5 * (off(random) + 0.03);
    drifting.balls.add(
        {0.5 * i + aside * off(random), 0.5 * j + aside * off(random), kRadius - depth - overlap}, kRadius);
    drifting.velocities.push_back(slow(random));
  }
  return expect_forces_of_a_search(surface, drifting);
}
TEST(SteadyFeet, SeveralAreAllThereAre) { EXPECT_GT(in_pits(0.1).three, 1000); }
// The same where edges are smooth, so that of several faces the nearest counts.
TEST(SteadyFeet, OverSmoothEdges) { in_pits(0.004); }

/// Anywhere on the pits, or below them, most of them just above another foot than they have.
Touching anywhere_on_pits(double size, double depth) {
  std::mt19937 random(7);
  const brep::Surface surface = pits(random, 12, size, depth);
  const brep::FootSearch search(surface);
  std::uniform_real_distribution<double> at(2.0 * size, 10.0 * size), gap(-2e-4, 2e-4);
  BallsThatDrift drifting;
  for (int k = 0; k < 300; ++k) {
    const double side = k % 3 == 0 ? -1.0 : 1.0;
    Vector3 centre(at(random), at(random), side * 0.95 * kRadius);
    const std::vector<brep::Foot> feet = feet_by_search(search, centre, 2.0 * kRadius);
    const brep::Foot& last =
        feet[std::min<size_t>(k % 4, feet.size() - 1)];  // it is about to touch, or to leave
    centre += (kRadius + gap(random) - last.distance) / last.distance * (centre - last.point);
    drifting.balls.add(centre, kRadius);
    drifting.velocities.push_back(slow(random));
  }
  return expect_forces_of_a_search(surface, drifting);
}
TEST(SteadyFeet, OnEdges) {
  EXPECT_GT(anywhere_on_pits(0.3, 0.1).edges, 20000);
  EXPECT_GT(anywhere_on_pits(0.3, 0.004).edges, 20000);  // some of them are smooth
  EXPECT_GT(anywhere_on_pits(0.1, 0.001).edges, 20000);
}

/// A ball that moves by this in each step has the forces of a search; the most contacts it has.
size_t most_contacts(const brep::Surface& surface, const Vector3& centre, const Vector3& way) {
  const brep::FootSearch search(surface);
  RigidSurface wall(std::make_shared<brep::Surface>(surface));
  Balls balls(8, 1);
  balls.add(centre, kRadius, way);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  size_t most = 0;
  for (int step = 1; step <= 200; ++step) {
    scene.balls.centre(0) += way;
    scene.evaluate();
    EXPECT_EQ(scene.balls.force(0), force_by_search(search, scene.balls.centre(0))) << step;
    most = std::max(most, scene.spring.seen.size());
  }
  return most;
}

// In a plate with a notch of 60 degrees: who is over the one flank and comes past the tip's end of the other
// edge has a second foot there, at once.
TEST(SteadyFeet, SeeEdgesBegin) {
  const std::vector<double> rays{60, 110, 160, 205, 250, 300, 360};  // no two at right angles or opposite
  nurbs::NodalVectors points(3, 8);
  points.col(0).setZero();
  std::vector<int> triangles;
  for (int k = 1; k <= 7; ++k) {
    const double angle = rays[k - 1] * EIGEN_PI / 180.0;
    points.col(k) = 4.0 * Vector3(std::cos(angle), std::sin(angle), 0.0);
    if (k < 7) triangles.insert(triangles.end(), {0, k, k + 1});
  }
  const brep::Surface plate = brep::from_triangles(points, triangles);
  EXPECT_EQ(most_contacts(plate, {-0.05, 0.2, 0.4}, {5e-4, 0.0, 0.0}), 2u);
}

// Up two slightly concave edges to a crest: its foot gives way to that on the plane until they are more than
// 0.02 rad apart.
TEST(SteadyFeet, SeeFeetThatTurnAway) {
  constexpr double kBend = 0.015, kWidth = 5e-4, kHeight = 0.49;
  nurbs::NodalVectors points(3, 10);
  const double x[5] = {-1.0, 0.0, kWidth, 2.0 * kWidth, 1.0};
  const double z[5] = {0.0, 0.0, kBend * kWidth, 3.0 * kBend * kWidth, -0.25};
  std::vector<int> triangles;
  for (int k = 0; k < 5; ++k) {
    points.col(2 * k) = Vector3(x[k], -1.0, z[k]);
    points.col(2 * k + 1) = Vector3(x[k], 1.0, z[k]);
    const int a = 2 * k;
    if (k < 4) triangles.insert(triangles.end(), {a, a + 2, a + 1, a + 1, a + 2, a + 3});
  }
  const Vector3 before(2.0 * kWidth - 0.0199 * kHeight, 0.3, kHeight);
  EXPECT_EQ(most_contacts(brep::from_triangles(points, triangles), before, {-2e-6, 0.0, 0.0}), 2u);
}

// The rim of the plane that others of the block are on.
TEST(SteadyFeet, OnTheEdgeOfTheFaceOfOthers) {
  nurbs::NodalVectors points(3, 8);
  points << -4, 4, 4, -4, 6, 8, 8, 6,  // and another plane a little higher
      -4, -4, 4, 4, -4, -4, 4, 4,      //
      0, 0, 0, 0, 0.005, 0.005, 0.005, 0.005;
  const brep::Surface surface = brep::from_triangles(points, {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
  for (const Vector3& beyond : {Vector3(4.1, 0.3, 0.45), Vector3(-4.1, 0.3, 0.45), Vector3(0.3, 4.1, 0.45),
                                Vector3(0.3, -4.1, 0.45)}) {
    BallsThatDrift drifting;
    drifting.balls.add(beyond, kRadius);
    for (int k = 0; k < 5; ++k) drifting.balls.add({0.3 * k, 0.2, 0.49}, kRadius);
    drifting.velocities.assign(6, Vector3(1e-6, 2e-6, 0.0));
    EXPECT_EQ(expect_forces_of_a_search(surface, drifting).edges, 300);
  }
}

}  // namespace
