// SPDX-License-Identifier: GPL-2.0-or-later
// Balls on walls of one patch that turns inside, and on patches of which many meet in one edge: as on the
// same walls of triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "balls.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "walls.h"

namespace {

using coupling::RigidSurface;
using nurbs::KnotVector;
using nurbs::Vector3;
using test::Balls;
using test::BallsOnWall;
using test::kRadius;
using test::wall_of;

/// Strips along y, 8 wide: a valley, a ridge, a valley and a step down.
const std::vector<Vector3> kProfile = {{-6, -4, 1.5}, {-3, -4, 0},  {0, -4, 1},   {2, -4, 0},
                                       {4, -4, 0.3},  {6, -4, 0.3}, {8, -4, -0.4}};

/// One patch of degree 1 along the profile, or of degree 2 whose points are moved along y, so that no strip
/// is in a closed form.
std::vector<nurbs::Surface> one_patch(bool in_closed_form) {
  const int n = static_cast<int>(kProfile.size());
  nurbs::Surface patch{nurbs::Space<2>({KnotVector::uniform(1, n - 1, 0.0, 3.0), KnotVector::uniform(1, 1)}),
                       nurbs::NodalVectors(3, 2 * n)};
  for (int i = 0; i < n; ++i) {
    patch.control_points.col(i) = kProfile[i];
    patch.control_points.col(i + n) = kProfile[i] + 8.0 * Vector3::UnitY();
  }
  if (in_closed_form) return {patch};
  for (int i = 0; i < 2; ++i) patch = nurbs::elevate_degree(patch, i);
  const int along = patch.space.control_point_count(0);
  for (int i = 1; i < along; i += 2) patch.control_points(1, i + along) += 0.3;
  return {patch};
}

RigidSurface triangles() {
  const int n = static_cast<int>(kProfile.size());
  nurbs::NodalVectors points(3, 2 * n);
  std::vector<int> numbers;
  for (int i = 0; i < n; ++i) {
    points.col(i) = kProfile[i];
    points.col(i + n) = kProfile[i] + 8.0 * Vector3::UnitY();
    if (i + 1 < n) numbers.insert(numbers.end(), {i, i + 1, i + 1 + n, i, i + 1 + n, i + n});
  }
  return wall_of(points, numbers);
}

/// How long each contact lasts, and its force, in an order of their own.
std::vector<std::pair<double, double>> contacts_of(const BallsOnWall& scene) {
  std::vector<std::pair<double, double>> all;
  for (const contact::Contact& c : scene.spring.seen)
    all.emplace_back(c.history[0], 1e-10 * std::round(1e10 * c.overlap));
  std::sort(all.begin(), all.end());
  return all;
}

// Along the profile, pressed by up to 0.1 r, above and below.
void expect_same_as_on_triangles(bool in_closed_form) {
  RigidSurface patch = wall_of(one_patch(in_closed_form)), mesh = triangles();
  for (const double side : {1.0, -1.0}) {
    Balls balls(3, 1);
    balls.add(Vector3::Zero(), kRadius);
    BallsOnWall on_patch(patch, balls, 1.0, 1.0), on_mesh(mesh, balls, 1.0, 1.0);
    constexpr int kSteps = 8000;
    long with_two = 0;
    for (int step = 0; step <= kSteps; ++step) {
      const double x = -5.0 + 12.0 * step / kSteps;
      const auto next =
          std::find_if(kProfile.begin() + 1, kProfile.end() - 1, [&](const Vector3& p) { return p[0] > x; });
      const Vector3 a = *(next - 1), b = *next;
      const double slope = (b[2] - a[2]) / (b[0] - a[0]), height = a[2] + slope * (x - a[0]);
      const Vector3 centre(x, 0.1 + 1e-4 * step, height + side * 0.95 * kRadius * std::hypot(1.0, slope));
      for (BallsOnWall* scene : {&on_patch, &on_mesh}) {
        scene->balls.centre(0) = centre;
        if (step % 50 == 0) scene->build_list();
        scene->evaluate();
      }
      ASSERT_LT((on_patch.balls.force(0) - on_mesh.balls.force(0)).norm(), 1e-11) << side << ' ' << x;
      ASSERT_EQ(contacts_of(on_patch), contacts_of(on_mesh)) << side << ' ' << x;
      with_two += on_mesh.spring.seen.size() == 2;
      for (const contact::Contact& c : on_patch.spring.seen) {
        ASSERT_EQ(c.foot.patch, 0);
        const nurbs::MultiPatch& surface = on_patch.loop.wall().surface();
        const Vector3 at =
            nurbs::interpolate(surface.patch(0), on_patch.loop.wall().control_points(), c.foot.xi);
        ASSERT_LT((at - (c.centre - c.delta)).norm(), 1e-12);
      }
    }
    EXPECT_GT(with_two, 100);
  }
}

TEST(Kinks, OfOneFlatFacettedPatchAreThoseOfTriangles) { expect_same_as_on_triangles(true); }
TEST(Kinks, OfOnePatchAreThoseOfTriangles) { expect_same_as_on_triangles(false); }

contact::ContactSlot slot_of(BallsOnWall& scene, const contact::Contact& contact) {
  return scene.balls.view().memory.slot(contact.particle, contact.slot);
}

// After a restart contacts are known again by their slots.
void expect_contacts_go_on(RigidSurface& wall, const BallsOnWall& scene, std::size_t count) {
  ASSERT_EQ(scene.spring.seen.size(), count);
  const double lasted = scene.spring.seen[0].history[0];
  BallsOnWall again(wall, scene.balls, 1.0, 1.0);
  again.evaluate();
  ASSERT_EQ(again.spring.seen.size(), count);
  for (const contact::Contact& c : again.spring.seen) EXPECT_EQ(c.history[0], lasted + 2.0);
}

// One stays on the kink while another one presses: its parameters are those of two parts, but for round-off.
TEST(Kinks, ContactsThatStayOnThemGoOnAfterARestart) {
  for (const bool in_closed_form : {true, false})
    for (const double way : {0.22, -0.15}) {
      RigidSurface wall = wall_of(one_patch(in_closed_form));
      Balls balls(3, 1);
      balls.add({-3.0, 0.0, 0.4}, kRadius);  // in the valley
      BallsOnWall scene(wall, balls, 1.0, 1.0);
      for (int step = 1; step < 100; ++step) {
        scene.balls.centre(0)[0] = -3.0 + way * step / 100.0;
        scene.evaluate();
      }
      const auto is_on_kink = [](const contact::Contact& c) { return std::abs(c.foot.xi[0] - 0.5) < 1e-9; };
      EXPECT_EQ(std::count_if(scene.spring.seen.begin(), scene.spring.seen.end(), is_on_kink), 1);
      std::vector<int> parts;
      for (const contact::Contact& c : scene.spring.seen)
        parts.push_back(wall.surface().faced->parts.part_at(slot_of(scene, c).foot()));
      std::sort(parts.begin(), parts.end());
      EXPECT_EQ(parts, std::vector<int>({0, 1}));
      expect_contacts_go_on(wall, scene, 2);
    }
}

// A strip whose end comes back to one of its own kinks: below it a ball goes from the one side of the patch
// to the other, over a convex edge of three.
TEST(Kinks, AContactThatComesToTheOtherSideOfThePatchGoesOn) {
  const std::vector<Vector3> profile = {{-3, -4, 0}, {0, -4, 0}, {2, -4, 2.5}, {3, -4, 1}, {0, -4, 0}};
  for (const double skew : {0.0, 0.4}) {
    nurbs::Surface patch{nurbs::Space<2>({KnotVector::uniform(1, 4), KnotVector::uniform(1, 1)}),
                         nurbs::NodalVectors(3, 10)};
    for (int i = 0; i < 5; ++i) {
      patch.control_points.col(i) = profile[i];
      patch.control_points.col(i + 5) = profile[i] + Vector3(0, 8.0 + skew * profile[i][0], 0);
    }
    RigidSurface wall = wall_of(std::vector<nurbs::Surface>{patch});
    Balls balls(3, 1);
    balls.add({-1.0, 0.0, -0.48}, kRadius);
    BallsOnWall scene(wall, balls, 1.0, 1.0);
    for (int step = 1; step <= 200; ++step) {
      const double x = -1.0 + 0.01 * step;
      scene.balls.centre(0) = Vector3(x, 0.0, std::max(x, 0.0) / 3.0 - 0.48);
      if (step % 10 == 0) scene.build_list();
      scene.evaluate();
      ASSERT_EQ(scene.spring.seen.size(), 1u) << step;
      EXPECT_EQ(scene.spring.seen[0].history[0], step + 1.0);
    }
    EXPECT_GT(scene.spring.seen[0].foot.xi[0], 0.8);
    EXPECT_EQ(slot_of(scene, scene.spring.seen[0]).side(), 1);
    expect_contacts_go_on(wall, scene, 1);
  }
}

// Balls that fall into the valleys and roll out again, over the ridges and through each other.
TEST(Kinks, EnergyIsKept) {
  constexpr double kStiffness = 400.0, kStep = 5e-5;
  for (const bool in_closed_form : {true, false}) {
    RigidSurface wall = wall_of(one_patch(in_closed_form));
    Balls balls(4, 1);
    for (int k = 0; k < 12; ++k)
      for (const double side : {1.0, -1.0})
        balls.add({-4.0 + 0.9 * k, -2.0 + 0.2 * k, side * 3.0}, kRadius, {0.1, 0.02 * k, -side});
    BallsOnWall scene(wall, balls, kStiffness, kStep);
    const auto energy = [&](int i) {
      double sum = 0.5 * scene.balls.velocity(i).squaredNorm();
      for (const contact::Contact& c : scene.spring.seen)
        if (c.particle == i) sum += 0.5 * kStiffness * c.overlap * c.overlap;
      return sum;
    };
    std::vector<double> start;
    for (int i = 0; i < scene.balls.count(); ++i) start.push_back(energy(i));
    long touching = 0;
    for (int step = 1; step <= 120000; ++step) {
      scene.step(step % 500 == 0);
      touching += static_cast<long>(scene.spring.seen.size());
      for (int i = 0; step % 100 == 0 && i < scene.balls.count(); ++i) {
        ASSERT_NEAR(energy(i) / start[i], 1.0, 1e-6) << i << " at step " << step;
      }
    }
    EXPECT_GT(touching, 50000);
  }
}

}  // namespace
