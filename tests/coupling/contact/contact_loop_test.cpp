// SPDX-License-Identifier: GPL-2.0-or-later
// The contact loop without a deck: balls on springs against motions and forces known in closed form.
#include "coupling/contact/contact_loop.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numeric>

#include "balls.h"
#include "coupling/contact/contact_totals.h"
#include "coupling/force_distribution.h"
#include "coupling/rigid/rigid_surface.h"
#include "nurbs/primitives.h"
#include "rising_sheet.h"
#include "walls.h"

namespace {

using contact::WallContact;
using coupling::RigidSurface;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;
using test::RisingSheet;
using testing::HasSubstr;

nurbs::Surface plate(const Vector3& origin, const Vector3& u, const Vector3& v) {
  return nurbs::plane(origin, u, v, {nurbs::KnotVector::uniform(2, 8), nurbs::KnotVector::uniform(2, 8)});
}
nurbs::Surface floor() { return plate({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}); }
/// z = 0 for x > 0 and x = 0 for z > 0.
std::vector<nurbs::Surface> corner() {
  return {plate({0, -4, 0}, {4, 0, 0}, {0, 8, 0}), plate({0, -4, 4}, {0, 0, -4}, {0, 8, 0})};
}

// m x'' = -k x for half a period: the ball leaves with the speed with which it came, after pi sqrt(m/k), and
// sinks in by v sqrt(m/k).
TEST(ContactLoop, ABallBouncesOffAPlane) {
  constexpr double kStiffness = 400.0, kSpeed = 1.0, kStep = 1e-4;
  RigidSurface wall({floor()});
  Balls balls;
  balls.add({0.3, -0.7, kRadius}, kRadius, {0.25, 0, -kSpeed});
  BallsOnWall scene(wall, balls, kStiffness, kStep);
  test::expect_half_an_oscillation(scene, kStiffness, kSpeed, kStep);
  EXPECT_EQ(scene.balls.velocity(0)[0], 0.25);
  EXPECT_EQ(scene.loop.crossing().count, 0);
  EXPECT_EQ(scene.loop.inside().count, 0);
}

// In a corner a ball has a contact on each side, each with a slot and a history of its own: while the one
// lasts the other may end and begin anew.
TEST(ContactLoop, BranchesKeepTheirSlots) {
  RigidSurface wall(corner());
  Balls balls(2, 1);
  balls.add({0.45, 0.0, 0.45}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  const auto history_at = [&](int side) {  // 0: of the floor, 2: of the upright one; -1: no contact
    for (const contact::Contact& c : scene.spring.seen)
      if (c.delta[side == 0 ? 2 : 0] > 0.4) return c.history[0];
    return -1.0;
  };
  for (int step = 1; step < 40; ++step) {
    const bool both = step < 10 || step >= 20;
    scene.balls.centre(0) = Vector3(both ? 0.45 : 0.55, 0.01 * step, 0.45);
    scene.evaluate();
    ASSERT_EQ(scene.spring.seen.size(), both ? 2u : 1u) << step;
    EXPECT_EQ(history_at(0), step + 1);
    EXPECT_EQ(history_at(2), step < 10 ? step + 1 : both ? step - 19 : -1);
    const Vector3 F = scene.balls.force(0);
    EXPECT_LT((F - Vector3(both ? 0.05 : 0.0, 0.0, 0.05)).norm(), 1e-14);
  }
}

// A ball out of reach costs no search until it may have come into reach, and is missed by no step, whether it
// moves or grows.
TEST(ContactLoop, QuietBallsAreLeftAloneAndNotMissed) {
  for (const bool grows : {false, true}) {
    RigidSurface wall({floor()});
    Balls balls;
    balls.add({0, 0, 0.65}, kRadius);
    BallsOnWall scene(wall, balls, 1.0, 1.0);
    const auto searches = [&] {
      const auto& n = scene.loop.searches().by_status;
      return n[0] + n[1] + n[2] + n[3];
    };
    const long before = searches();
    for (int step = 1; step <= 20; ++step) {
      const double way = 0.01 * step - 1e-9;
      (grows ? scene.balls.radius[0] : scene.balls.x[2]) = grows ? kRadius + way : 0.65 - way;
      scene.evaluate();
      const bool touches = step > 15;
      EXPECT_EQ(scene.loop.contacts().size(), touches ? 1u : 0u) << step << (grows ? " grows" : " moves");
      if (step == 10) {
        EXPECT_LE(searches() - before, 2);
      }
      if (touches) {
        EXPECT_NEAR(scene.balls.force(0)[2], way - 0.15, 1e-14);
      }
    }
  }
}

// Slower than the list allows for, a particle may grow out of it: the list is then not good any more.
TEST(ContactLoop, TellsWhenAParticleHasOutgrownTheList) {
  RigidSurface wall({floor()});
  Balls balls;
  balls.add({0, 0, 0.9}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  scene.balls.radius[0] = kRadius + 0.49 * BallsOnWall::kSkin;
  EXPECT_FALSE(scene.loop.has_outgrown_list(scene.balls.view()));
  scene.balls.radius[0] = kRadius + 0.51 * BallsOnWall::kSkin;
  EXPECT_TRUE(scene.loop.has_outgrown_list(scene.balls.view()));
  scene.balls.radius[0] = 1.0;
  scene.evaluate();
  EXPECT_NEAR(scene.balls.force(0)[2], 0.1, 1e-14);
}

// A ball at rest on a floor grows until it touches the wall beside it, by less than what its list allows for.
TEST(ContactLoop, SteadyContactsGrow) {
  nurbs::NodalVectors points(3, 6);
  points << 0, 4, 4, 0, 0, 0,  //
      -4, -4, 4, 4, -4, 4,     //
      0, 0, 0, 0, 4, 4;
  RigidSurface wall = test::wall_of(points, {0, 1, 2, 0, 2, 3, 0, 3, 5, 0, 5, 4});
  constexpr double kBeside = kRadius + 0.35 * BallsOnWall::kSkin;
  Balls balls(8, 1);
  balls.add({kBeside, 0.0, 0.9 * kRadius}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  double& radius = scene.balls.radius[0];
  for (; radius < kRadius + 0.49 * BallsOnWall::kSkin; radius += 0.01 * BallsOnWall::kSkin) {
    scene.evaluate();
    EXPECT_EQ(scene.spring.seen.size(), radius < kBeside ? 1u : 2u) << radius;
  }
}

// A wall that comes to a ball at rest, by far more than a skin.
TEST(ContactLoop, FollowsAWallThatMoves) {
  constexpr double kStep = 0.01, kSpeed = 0.5;
  RigidSurface wall({floor()});
  wall.set_motions({coupling::linear({0, 0, kSpeed})});
  Balls balls;
  balls.add({0.1, 0.2, 1.5}, kRadius);
  BallsOnWall scene(wall, balls, 0.0, kStep);
  int first = 0;
  for (int step = 1; step <= 220; ++step) {
    scene.step();
    const double overlap = kRadius - (1.5 - kSpeed * kStep * step);
    ASSERT_EQ(scene.loop.contacts().size(), overlap >= 0.0 ? 1u : 0u) << step;
    if (overlap < 0.0) continue;
    if (first == 0) first = step;
    EXPECT_NEAR(scene.loop.contacts()[0].overlap, overlap, 1e-12);
    EXPECT_LT((scene.spring.seen[0].wall_velocity - Vector3(0, 0, kSpeed)).norm(), 1e-14);
  }
  EXPECT_EQ(first, 200);
}

// A ball at rest is left alone, but not while the surface may have come to it; its force is spread to the
// control points.
TEST(ContactLoop, FollowsASurfaceThatDeforms) {
  constexpr double kStep = 0.01, kSpeed = 0.47;
  RisingSheet sheet(floor(), kSpeed);
  Balls balls;
  balls.add({0.1, 0.2, 1.0}, kRadius);
  BallsOnWall scene(sheet, balls, 0.0, kStep);
  for (int step = 1; step <= 130; ++step) {
    scene.step();
    const double overlap = kRadius - (1.0 - kSpeed * kStep * step);
    ASSERT_EQ(scene.loop.contacts().size(), overlap >= 0.0 ? 1u : 0u) << step;
    ASSERT_EQ(scene.loop.forces_on_body().size(), scene.loop.contacts().size());
    if (scene.loop.contacts().empty()) continue;
    EXPECT_NEAR(scene.loop.contacts()[0].overlap, overlap, 1e-13);
    EXPECT_LT((scene.spring.seen[0].wall_velocity - Vector3(0, 0, kSpeed)).norm(), 1e-13);
  }
}

// Two masses on the spring: a ball of mass 1 and the sheet, which gives way along z alone.
TEST(ContactLoop, StopsWhereAContactIsTooStiffForTheStep) {
  constexpr double kStiffness = 100.0, kNodeMass = 0.2;
  RisingSheet sheet(floor(), 0.0);
  sheet.inverse_mass = Vector3(0, 0, 1.0 / kNodeMass).replicate(1, sheet.positions().cols());
  const nurbs::SurfacePoint foot{0, {0.6, 0.7}};
  const Vector3 place = nurbs::interpolate(sheet.surface().topology.patch(0), sheet.positions(), foot.xi);
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(sheet.surface().topology.patch(0), foot.xi, 0, basis);
  double squares = 0.0;
  for (int a = 0; a < basis.count; ++a) squares += basis.R[a] * basis.R[a];
  const double stable = 2.0 / std::sqrt(kStiffness * (squares / kNodeMass + 1.0));
  Balls balls;
  balls.add(place + Vector3(0, 0, 0.9 * kRadius), kRadius);
  EXPECT_NO_THROW(BallsOnWall(sheet, balls, kStiffness, 0.999 * stable));
  try {
    BallsOnWall(sheet, balls, kStiffness, 1.001 * stable);
    FAIL() << "a step above the stable one";
  } catch (const std::runtime_error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("the contact of particle 1 is too stiff for the timestep"));
    EXPECT_THAT(problem.what(), HasSubstr(fmt::format("is stable below {:.4g}", stable)));
  }
  sheet.inverse_mass.setZero();  // held
  EXPECT_NO_THROW(BallsOnWall(sheet, balls, kStiffness, 1.001 * stable));
}

// Nodes of the sheet on springs of their own, and the ball's between: the dense matrix says when the step is
// too long, and the alarm never comes later.
TEST(ContactLoop, WarnsWhereContactAndBodyTogetherMayBeTooStiff) {
  constexpr double kStiffness = 100.0, kNodeMass = 0.2;
  RisingSheet sheet(floor(), 0.0);
  const auto nodes = sheet.positions().cols();
  sheet.inverse_mass = Vector3(0, 0, 1.0 / kNodeMass).replicate(1, nodes);
  const nurbs::SurfacePoint foot{0, {0.6, 0.7}};
  const Vector3 place = nurbs::interpolate(sheet.surface().topology.patch(0), sheet.positions(), foot.xi);
  nurbs::NodalVectors unit = nurbs::NodalVectors::Zero(3, nodes);
  coupling::FootBasis(sheet.surface().topology, foot).distribute(Vector3(0, 0, 1), unit);
  Eigen::VectorXd b(nodes + 1);  // the spring's elongation for motion over root mass: of nodes, of the ball
  b << unit.row(2).transpose() / std::sqrt(kNodeMass), -1.0;
  Balls balls;
  balls.add(place + Vector3(0, 0, 0.9 * kRadius), kRadius);
  for (const bool alike : {true, false})
    for (const double omega : {1.0, 10.0, 30.0}) {
      Eigen::VectorXd squares = Eigen::VectorXd::Constant(nodes + 1, omega * omega);
      if (!alike) squares.tail(nodes).setLinSpaced(0.0, omega * omega);
      squares[nodes] = 0.0;
      if (!alike) squares[0] = omega * omega;  // far from the contact
      const Eigen::MatrixXd A = Eigen::MatrixXd(squares.asDiagonal()) + kStiffness * b * b.transpose();
      const double highest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues().maxCoeff(),
                   bound = omega * omega + kStiffness * b.squaredNorm();
      EXPECT_LE(highest, bound);
      sheet.stable_step = 2.0 / omega;
      const auto alarms = [&](double dt) { return BallsOnWall(sheet, balls, kStiffness, dt).loop.stiff(); };
      EXPECT_EQ(alarms(0.999 * 2.0 / std::sqrt(bound)).count, 0);
      const contact::RunAlarm alarm = alarms(1.001 * 2.0 / std::sqrt(bound));
      EXPECT_EQ(alarm.count, 1);
      EXPECT_EQ(alarm.tag, 1);
      EXPECT_NEAR(alarm.speed, std::sqrt(bound), 1e-9 * alarm.speed);
    }
}

// The wall feels the opposite of what the balls feel, at the feet, and gives the power that its motion has.
TEST(ContactLoop, ForceTorqueAndPowerOfTheWall) {
  RigidSurface wall(corner());
  wall.set_motions({coupling::linear({0.3, 0, 0.7})});
  Balls balls;
  balls.add({0.4, 1.0, 0.45}, kRadius);
  balls.add({2.0, -1.0, 0.3}, kRadius);
  BallsOnWall scene(wall, balls, 10.0, 1e-16);
  scene.step();
  contact::ContactSums sums;
  const contact::ContactTotals totals = sums.over_ranks(scene.loop.rows(), MPI_COMM_SELF);
  const Vector3 F_0(1.0, 0, 0.5), F_1(0, 0, 2.0);
  const Vector3 torque = Vector3(0, 1.0, 0.45).cross(Vector3(-1, 0, 0)) +
                         Vector3(0.4, 1.0, 0).cross(Vector3(0, 0, -0.5)) +
                         Vector3(2.0, -1.0, 0).cross(Vector3(0, 0, -2.0));
  EXPECT_EQ(totals.contacts, 3.0);
  EXPECT_NEAR(totals.overlap, 0.2, 1e-14);
  EXPECT_LT((Vector3::Map(totals.force) + F_0 + F_1).norm(), 1e-13);
  EXPECT_LT((Vector3::Map(totals.torque) - torque).norm(), 1e-13);
  EXPECT_NEAR(totals.power, Vector3(0.3, 0, 0.7).dot(F_0 + F_1), 1e-13);
}

// Sums of contacts do not depend on which rank has them.
TEST(ContactSums, AreTheSameOnAnyRanks) {
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<WallContact> mine, all;
  for (int k = 0; k < 200; ++k) {
    WallContact row;
    row.tag = 1 + (37 * k) % 200;
    row.slot = k % 2;
    for (int d = 0; d < 3; ++d) row.force[d] = std::sin(k + d), row.torque[d] = 1e8 * std::cos(k * d);
    row.overlap = std::abs(std::sin(k)), row.power = std::exp(std::sin(k));
    all.push_back(row);
    if ((k / 3) % ranks == rank) mine.push_back(row);
  }
  contact::ContactSums sums, sums_of_one;
  const contact::ContactTotals a = sums.over_ranks(mine, MPI_COMM_WORLD);
  const contact::ContactTotals b = sums_of_one.over_ranks(all, MPI_COMM_SELF);
  EXPECT_EQ(a.contacts, 200.0);
  EXPECT_EQ(Vector3::Map(a.force), Vector3::Map(b.force));
  EXPECT_EQ(Vector3::Map(a.torque), Vector3::Map(b.torque));
  EXPECT_EQ(a.overlap, b.overlap);
  EXPECT_EQ(a.power, b.power);
}

// A floor that ends at the periodic face goes on beyond it.
TEST(ContactLoop, MeetsTheImagesOfTheWall) {
  const contact::PeriodicBox box{{-4, -9, -9}, {4, 9, 9}, {true, false, false}};
  RigidSurface wall({plate({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}), plate({-4, -4, 0}, {0, 0, 1}, {0, 8, 0})});
  Balls balls;
  balls.add({3.7, 0, 0.4}, kRadius);   // the floor here, the upright plate's image at x = 4
  balls.add({-3.8, 0, 2.0}, kRadius);  // above the plate: nothing
  balls.add({4.3, 1, 0.45}, kRadius);  // just outside, as particles are between two exchanges
  BallsOnWall scene(wall, balls, 1.0, 1.0, box);
  ASSERT_EQ(scene.spring.seen.size(), 4u);
  EXPECT_LT((scene.balls.force(0) - Vector3(-0.2, 0, 0.1)).norm(), 1e-14);
  EXPECT_EQ(scene.balls.force(1), Vector3::Zero());
  EXPECT_LT((scene.balls.force(2) - Vector3(0.2, 0, 0.05)).norm(), 1e-14);
}

// As a belt that moves on and on does.
TEST(ContactLoop, MeetsAWallThatIsPeriodsAway) {
  const contact::PeriodicBox box{{-4, -9, -9}, {4, 9, 9}, {true, false, false}};
  for (const double periods : {-3.0, -1.5, 2.0, 2.4, 1000.0}) {
    RigidSurface wall({plate({-4 + 8 * periods, -4, 0}, {8, 0, 0}, {0, 8, 0})});
    Balls balls;
    for (const double x : {-3.5, -0.5, 1.3, 3.8}) balls.add({x, 0.3, 0.4}, kRadius);
    BallsOnWall scene(wall, balls, 1.0, 1.0, box);
    EXPECT_EQ(scene.spring.seen.size(), 4u) << periods;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(scene.balls.force(k)[2], 0.1, 1e-12) << periods << ' ' << k;
  }
}

TEST(ContactLoop, LeavesOtherGroupsAlone) {
  RigidSurface wall({floor()});
  Balls balls;
  for (int k = 0; k < 100; ++k) balls.add({-3.9 + 0.07 * k, 0, 0.4}, kRadius);
  for (int k = 0; k < 100; k += 3) balls.mask[k] = 2;
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  for (int k = 0; k < 100; ++k) EXPECT_NEAR(scene.balls.force(k)[2], k % 3 == 0 ? 0.0 : 0.1, 1e-14) << k;
  EXPECT_EQ(scene.spring.batches, 2);  // not one call for each
  EXPECT_EQ(scene.loop.candidate_count(), 66);
}

// Inside a solid, and faster than its radius per step.
TEST(ContactLoop, RaisesAlarms) {
  test::RisingSheet wall(floor(), 0.0, 1);  // the top of a solid below z = 0
  Balls balls;
  balls.add({0, 0, -0.1}, kRadius, {0, 0, 0.05});
  balls.add({2, 0, 0.3}, kRadius, {0, 0, -0.4});
  balls.add({-2, 0, 0.3}, kRadius, {0, 0, -0.2});
  BallsOnWall scene(wall, balls, 0.0, 1.0);
  EXPECT_EQ(scene.loop.inside().count, 1);
  EXPECT_EQ(scene.loop.inside().tag, 1);
  EXPECT_EQ(scene.loop.crossing().count, 1);
  EXPECT_EQ(scene.loop.crossing().tag, 2);
  EXPECT_NEAR(scene.loop.crossing().speed, 0.4, 1e-14);
  scene.loop.forget_reports();
  EXPECT_EQ(scene.loop.inside().count, 0);
}

// What is drawn as a solid may be the tank that particles are in.
TEST(ContactLoop, RaisesNoneInARigidContainer) {
  RigidSurface wall({floor()}, {1});
  Balls balls;
  balls.add({0, 0, -0.1}, kRadius, {0, 0, 0.05});
  BallsOnWall scene(wall, balls, 0.0, 1.0);
  EXPECT_EQ(scene.loop.contacts().size(), 1u);
  EXPECT_EQ(scene.loop.inside().count, 0);
}

// Its contact goes on, and keeps its slot: on a curved patch, whose feet are followed.
TEST(ContactLoop, ABallThatIsPutElsewhereHasAnotherSide) {
  nurbs::Surface hill = floor();
  hill.control_points(2, hill.control_points.cols() / 2) += 0.1;
  test::RisingSheet wall(hill, 0.0, 1);
  Balls balls(1);
  balls.add({0.3, 0.2, 0.4}, kRadius);
  BallsOnWall scene(wall, balls, 1.0, 1.0);
  ASSERT_EQ(scene.loop.contacts().size(), 1u);
  EXPECT_EQ(scene.loop.inside().count, 0);
  scene.balls.centre(0)[2] = -0.4;
  scene.build_list();
  scene.evaluate();
  ASSERT_EQ(scene.loop.contacts().size(), 1u);
  EXPECT_EQ(scene.loop.inside().count, 1);
}

TEST(ContactLoop, SaysWhatIsTooManyOrNotFinite) {
  RigidSurface wall(corner());
  Balls balls(1);
  balls.add({0.45, 0.0, 0.45}, kRadius);
  try {
    BallsOnWall(wall, balls, 1.0, 1.0);
    FAIL() << "two contacts in one slot";
  } catch (const contact::TooManyContacts& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("particle 1 touches the wall in more than 1 places at step 0"));
  }
  RigidSurface plane({floor()});
  Balls one;
  one.add({0, 0, 0.4}, kRadius);
  try {
    BallsOnWall(plane, one, std::numeric_limits<double>::infinity(), 1.0);
    FAIL() << "an infinite force";
  } catch (const std::runtime_error& problem) {
    EXPECT_THAT(problem.what(),
                HasSubstr("the contact of particle 1 is not finite at step 0: centre (0, 0, 0.4)"));
  }
}

}  // namespace
