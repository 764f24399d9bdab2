// SPDX-License-Identifier: GPL-2.0-or-later
// Feet where derivatives do not tell: on poles, beside them, on saddles, and on the seam of a closed patch;
// in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "feet.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

using Status = FootStatus;

std::vector<Foot> minima(const Surface& surface, const Vector3& d) {
  const SurfaceProjector projector(surface.space, surface.control_points);
  std::vector<Foot> all;
  projector.all_minima(d, 100.0, all);
  return all;
}

Curve sector(double angle, int elements) { return refined(arc(0, angle), elements, 2); }

// A quarter cone of radius 3 and height 4: its tip is the foot of what lies beyond the planes normal to its
// generators, 3 rho <= 4 z; nearer to them the foot is on the generator of the point's azimuth.
TEST(Poles, TipOfACone) {
  const Surface quarter =
      cone(frame({0, 0, 0}, {0, 0, 1}), {3, 0}, 4, sector(90, 4), KnotVector::uniform(2, 3));
  const Vector3 tip(0, 0, 4);
  constexpr double kResolution = 5e-8;  // of directions beside a pole: the root of round-off
  for (const double azimuth : {0.2, M_PI / 4, 1.1})
    for (const double z : {0.3, 1.0, 2.0})
      for (const double excess : {-1.0, -0.5, -1e-3, -1e-6, -1e-8, 1e-8, 1e-6, 1e-3, 0.2}) {
        SCOPED_TRACE(testing::Message() << "azimuth " << azimuth << ", z " << z << ", excess " << excess);
        const double rho = 4.0 * z / 3.0 * (1.0 + excess);
        const Vector3 d = tip + Vector3(rho * std::cos(azimuth), rho * std::sin(azimuth), z);
        const double slant = std::max(0.0, (3.0 * rho - 4.0 * z) / 5.0);  // from the tip to the foot
        const Vector3 foot =
            tip + slant / 5.0 * Vector3(3.0 * std::cos(azimuth), 3.0 * std::sin(azimuth), -4.0);
        std::vector<Foot> found = minima(quarter, d);
        ASSERT_EQ(found.size(), 1u);
        for (const double xi : {0.0, 0.4, 1.0})
          for (const double eta : {0.0, 0.5, 1.0}) found.push_back(closest_from(quarter, d, {xi, eta}));
        for (const Foot& p : found) {
          EXPECT_NEAR((p.point - foot).norm(), 0.0, slant < kResolution ? kResolution : 1e-13);
          EXPECT_NEAR(p.distance, (d - foot).norm(), 1e-14);
          EXPECT_EQ(p.status != Status::interior, slant < kResolution);
        }
      }
}

// A dome with the half axes 5, 2.5, 5: at its pole the radii of curvature are 5 and 1.25.  From points on the
// axis the pole is a minimum down to a depth of 1.25; below, a saddle or maximum: just below, within a narrow
// angle about the short axis, wherever that lies between the elements' borders.
TEST(Poles, PoleOfAnEllipsoid) {
  const Vector3 pole(0, 0, 5);
  for (const double azimuth : {90.0, 90.3, 91.4, 95.0, 112.5})
    for (const double depth : {-40.0, -3.0, -0.01, 0.01, 0.7, 1.24, 1.2499, 1.2501, 1.2505, 1.26, 3.0, 4.9}) {
      SCOPED_TRACE(testing::Message() << "azimuth " << azimuth << ", depth " << depth);
      Surface dome = sphere(frame({0, 0, 0}, {0, 0, 1}), 5, sector(360, 8), refined(arc(0, 90), 3, 2));
      const double radians = azimuth * M_PI / 180.0;
      const Vector3 across(std::cos(radians), std::sin(radians), 0.0);
      dome.control_points.topRows<3>() -=
          0.5 * across * (across.transpose() * dome.control_points.topRows<3>());
      const Vector3 d(0, 0, 5.0 - depth);
      const std::vector<Foot> found = minima(dome, d);
      const auto on_pole = [&](const Foot& p) { return (p.point - pole).norm() < 1e-7; };
      EXPECT_EQ(std::count_if(found.begin(), found.end(), on_pole), depth < 1.25 ? 1 : 0);
      // Nearest: the pole, or beyond the focus y^2 / 6.25 + z^2 / 25 = 1 at z = (25 / 18.75) d_z.
      const double z = 25.0 / 18.75 * d.z(), y2 = 6.25 * (1.0 - z * z / 25.0);
      const double least = depth < 1.25 ? std::abs(depth) : std::sqrt(y2 + (z - d.z()) * (z - d.z()));
      EXPECT_NEAR(closest(dome, d).distance, least, 1e-12);
      for (const double eta : {0.0, 0.3, 1.0}) {
        const Foot p = closest_from(dome, d, {0.1, eta});
        EXPECT_NEAR(p.distance, least, 1e-12);
        EXPECT_NE(p.status, Status::not_converged);
      }
    }
}

// On the outer equator of a torus the distance from its centre is greatest, over the top of the tube's upper
// outer quarter it is least.  Far from the origin of space the slope on the edge is round-off, and no hold.
TEST(Poles, RoundOffHoldsNoMaximum) {
  shapes::Random random(42);
  const auto vector = [&](double most) {
    return Vector3(shapes::uniform(random, -most, most), shapes::uniform(random, -most, most),
                   shapes::uniform(random, -most, most));
  };
  for (int k = 0; k < 40; ++k) {
    const Vector3 centre = vector(3000);
    const Surface quarter = torus(frame(centre, vector(1)), 2, 1, sector(90, 3), refined(arc(0, 90), 3, 2));
    for (const double xi : {0.0, 0.2, 1.0 / 3.0, 0.9}) {
      const Foot p = closest_from(quarter, centre, {xi, 0.0});
      EXPECT_NEAR(p.distance, std::sqrt(5.0), 1e-11);
      EXPECT_EQ(p.xi[1], 1.0);
    }
  }
}

// A full cylinder is one patch with a seam: nothing of it is felt in the nearest foot.
TEST(Poles, SeamOfACylinder) {
  constexpr double kRadius = 10.0;
  const Surface tube =
      cylinder(frame({0, 0, 0}, {0, 0, 1}), kRadius, 20, sector(360, 4), KnotVector::uniform(2, 3));
  const SurfaceProjector projector(tube.space, tube.control_points);
  std::vector<int> elements(tube.space.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  shapes::Random random(41);
  for (int k = 0; k < 400; ++k) {
    const double azimuth = (k % 2 ? 1 : -1) * std::pow(10.0, shapes::uniform(random, -11.0, -2.0));
    const double height = shapes::uniform(random, 0.0, 20.0), gap = shapes::uniform(random, -0.4, 0.4);
    const Vector3 out(std::cos(azimuth), std::sin(azimuth), 0.0), up(0, 0, height);
    const Vector3 d = (kRadius + gap) * out + up, foot = kRadius * out + up;
    for (const Foot& p :
         {projector.cold(d), projector.cold_on(d, elements.data(), static_cast<int>(elements.size())),
          projector.nearest(d, {k % 3 ? 0.01 : 0.99, 0.5})}) {
      EXPECT_EQ(p.status, Status::interior) << "azimuth " << azimuth;
      EXPECT_NEAR((p.point - foot).norm(), 0.0, 1e-13) << "azimuth " << azimuth;
    }
  }
}

// Equally far from everything: one foot is as good as another, and the search ends.
TEST(Poles, CentresOfSpheresAndAxes) {
  const Surface ball = sphere(frame({3, 1, 2}, {1, 1, 1}), 5, sector(360, 8), refined(arc(-90, 90), 4, 2));
  const Surface tube = cylinder(frame({3, 1, 2}, {1, 1, 1}), 5, 2, sector(360, 8), KnotVector::uniform(2, 4));
  for (const Surface* surface : {&ball, &tube}) {
    const Vector3 d =
        surface == &ball ? Vector3(3, 1, 2) : Vector3(3, 1, 2) + Vector3(1, 1, 1) / std::sqrt(3.0);
    EXPECT_NEAR(closest(*surface, d).distance, 5.0, 1e-13);
    for (const double xi : {0.0, 0.06, 0.5, 1.0})
      for (const double eta : {0.0, 0.3, 1.0}) {
        const Foot p = closest_from(*surface, d, {xi, eta});
        EXPECT_NEAR(p.distance, 5.0, 1e-13);
        EXPECT_NE(p.status, Status::not_converged);
      }
    const std::vector<Foot> found = minima(*surface, d);
    EXPECT_FALSE(found.empty());
    for (const Foot& p : found) EXPECT_NEAR(p.distance, 5.0, 1e-13);
  }
}

// Beside the centre by a part of the radius down to round-off: both curvatures of the distance are that
// small, and its least value is the radius less the offset.  A warm search stays below its guess.
TEST(Poles, BesideTheCentreOfASphere) {
  constexpr double kRadius = 7.0;
  const Vector3 centre(0.3, -0.2, 0.1);
  const Surface ball =
      sphere(frame(centre, {1, 2, 2}), kRadius, refined(arc(0, 360), 8, 3), refined(arc(-90, 90), 4, 3));
  const SurfaceProjector projector(ball.space, ball.control_points);
  std::vector<int> elements(ball.space.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  shapes::Random random(43);
  for (int k = 0; k < 3000; ++k) {
    std::normal_distribution<double> normal;
    const Vector3 aside = Vector3(normal(random), normal(random), normal(random)).normalized();
    const double off = kRadius * std::pow(10.0, shapes::uniform(random, -12.0, -5.0));
    const Vector3 d = centre + off * aside;
    const Parameter<2> guess = shapes::random_parameter(random, ball.space);
    const double least = kRadius - off,
                 of_guess = (interpolate(ball.space, ball.control_points, guess) - d).norm();
    SCOPED_TRACE(testing::Message() << "point " << k << ", off by " << off);
    EXPECT_NEAR(projector.cold(d).distance, least, 1e-10 * kRadius);
    EXPECT_NEAR(projector.nearest(d, guess).distance, least, 1e-10 * kRadius);
    EXPECT_NEAR(projector.cold_on(d, elements.data(), static_cast<int>(elements.size())).distance, least,
                1e-10 * kRadius);
    EXPECT_LE(projector.warm(d, guess).distance, of_guess + 1e-15 * kRadius);
  }
}

}  // namespace
}  // namespace search
