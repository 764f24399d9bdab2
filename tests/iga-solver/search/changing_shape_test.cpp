// SPDX-License-Identifier: GPL-2.0-or-later
// Searches on a surface that changes its shape, not merely its place: results do not depend on what was asked
// before, so one projector that has seen other shapes gives what a new one gives, to the last bit.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "feet.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"
#include "search/multi_patch_projector.h"

namespace search {
namespace {

using namespace nurbs;

std::vector<int> all_elements(int count) {
  std::vector<int> elements(count);
  std::iota(elements.begin(), elements.end(), 0);
  return elements;
}

// A sheet over the unit square, bent, corrugated, sheared and stretched by turns, so that what holds of one
// shape does not of the next: troughs and ridges as narrow as two elements, feet in other places, larger and
// smaller boxes.
NodalVectors shape(const Surface& sheet, int step) {
  NodalVectors points = sheet.control_points;
  const double phase = 1.7 * step, height = step % 3 == 0 ? 0.0 : 0.3, waves = step % 4 < 2 ? 9.0 : 4.0;
  const double shear = step % 5 == 1 ? 0.8 : 0.0, stretch = step % 7 == 2 ? 3.0 : 1.0;
  for (Eigen::Index a = 0; a < points.cols(); ++a) {
    const double x = points(0, a), y = points(1, a);
    points.col(a) << stretch * x + shear * y, y,
        height * std::sin(waves * x + phase) * std::cos(2.0 * y - phase);
  }
  return points;
}

void expect_same(const Foot& p, const Foot& expected) {
  EXPECT_EQ(p.distance, expected.distance);
  EXPECT_EQ(p.point, expected.point);
  EXPECT_EQ(p.xi, expected.xi);
  EXPECT_EQ(p.status, expected.status);
}
template <class Feet>
void expect_same_feet(const Feet& feet, const Feet& expected) {
  ASSERT_EQ(feet.size(), expected.size());
  for (size_t k = 0; k < feet.size(); ++k) expect_same(feet[k], expected[k]);
}

TEST(ChangingShape, EverySearchIsThatOfANewProjector) {
  for (const bool rational : {false, true}) {
    shapes::Random random(51);
    Surface sheet =
        plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {KnotVector::uniform(2, 16), KnotVector::uniform(3, 11)});
    if (rational)
      sheet.space =
          Space<2>(sheet.space.knots(), shapes::random_weights(random, sheet.space.control_point_count()));
    const std::vector<int> elements = all_elements(sheet.space.element_count());
    const int count = static_cast<int>(elements.size());
    NodalVectors points = sheet.control_points;
    SurfaceProjector old(sheet.space, points);
    for (int step = 0; step < 24; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step << (rational ? ", rational" : ""));
      points = shape(sheet, step);
      const SurfaceProjector fresh(sheet.space, points);
      old.surface_moved();
      std::vector<Vector3> d;
      std::vector<Parameter<2>> guesses;
      for (int k = 0; k < 20; ++k) {
        guesses.push_back(shapes::random_parameter(random, sheet.space));
        const Vector3 S = interpolate(sheet.space, points, guesses[k]);
        const auto part = [&] { return shapes::uniform(random, -1.0, 1.0); };
        d.push_back(S + (k % 2 == 0 ? 0.02 : 0.25) * Vector3(part(), part(), part()));
      }
      // The order of the searches changes, so that each is the first to use what the last step left behind.
      for (int search = step; search < step + 6; ++search)
        for (int k = 0; k < 20; ++k) {
          std::vector<Foot> all, expected;
          const double reach = k % 2 == 0 ? 0.05 : 0.3;
          switch (search % 6) {
            case 0:
              expect_same(old.warm(d[k], guesses[k]), fresh.warm(d[k], guesses[k]));
              break;
            case 1:
              expect_same(old.cold(d[k]), fresh.cold(d[k]));
              break;
            case 2:
              expect_same(old.nearest(d[k], guesses[k]), fresh.nearest(d[k], guesses[k]));
              break;
            case 3:
              expect_same(old.cold_on(d[k], elements.data(), count),
                          fresh.cold_on(d[k], elements.data(), count));
              break;
            case 4:
              old.all_minima(d[k], reach, all);
              fresh.all_minima(d[k], reach, expected);
              expect_same_feet(all, expected);
              break;
            default:
              old.all_minima_on(d[k], reach, elements.data(), count, all);
              fresh.all_minima_on(d[k], reach, elements.data(), count, expected);
              expect_same_feet(all, expected);
          }
        }
      expect_same_feet(closest_from(old, d, guesses), closest_from(fresh, d, guesses));
    }
  }
}

// A flat strip has one foot; bent to a trough as narrow as the points are high, two: those on its walls,
// which what was proved of the flat one would hide.
TEST(ChangingShape, ATroughHasTwoFeetWhereTheFlatSheetHadOne) {
  const Surface strip =
      plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {KnotVector::uniform(2, 32), KnotVector::uniform(2, 8)});
  NodalVectors points = strip.control_points;
  SurfaceProjector projector(strip.space, points);
  const auto bend = [&](double depth) {
    for (Eigen::Index a = 0; a < points.cols(); ++a)
      points(2, a) = depth * std::pow(2.0 * points(0, a) - 1.0, 2);
    projector.surface_moved();
  };
  std::vector<Foot> feet;
  for (int turn = 0; turn < 3; ++turn) {
    bend(0.0);
    for (const double y : {0.2, 0.5}) {
      projector.all_minima({0.5, y, 0.6}, 0.7, feet);
      ASSERT_EQ(feet.size(), 1U);
      EXPECT_NEAR(feet[0].distance, 0.6, 1e-13);
    }
    bend(
        1.0);  // z = (2 x - 1)^2, radius of curvature 1 / 8 at the bottom: its control points are off by less
    for (const double y : {0.2, 0.5}) {
      projector.all_minima({0.5, y, 0.6}, 0.7, feet);
      ASSERT_EQ(feet.size(), 2U) << "turn " << turn;
      EXPECT_NEAR(feet[0].distance, feet[1].distance, 1e-12);
      EXPECT_NEAR(feet[0].point[0] + feet[1].point[0], 1.0, 1e-12);
      EXPECT_LT(feet[0].distance, 0.5);
    }
  }
}

// The same across the borders of a ball that swells and becomes an egg.
TEST(ChangingShape, PatchesFollowTogether) {
  std::vector<Surface> patches;
  for (const double south : {-90.0, 0.0})
    for (int k = 0; k < 4; ++k)
      patches.push_back(sphere(frame({0, 0, 0}, {0, 0, 1}), 1.0, refined(arc(90.0 * k, 90.0 * (k + 1)), 2, 2),
                               refined(arc(south, south + 90.0), 2, 2)));
  const PatchedSurface ball = join(patches);
  const std::vector<int> elements = all_elements(ball.topology.element_count());
  const int count = static_cast<int>(elements.size());
  NodalVectors points = ball.control_points;
  MultiPatchProjector old(ball.topology, points);
  shapes::Random random(52);
  for (int step = 0; step < 12; ++step) {
    const Vector3 axes(1.0 + 0.3 * (step % 3), 1.0 - 0.2 * (step % 2), 1.0 + 0.5 * (step % 4));
    points = axes.asDiagonal() * ball.control_points;
    const MultiPatchProjector fresh(ball.topology, points);
    old.surface_moved();
    for (int k = 0; k < 40; ++k) {
      const Vector3 d = 2.0 * Vector3::NullaryExpr([&] { return shapes::uniform(random, -1.0, 1.0); });
      std::vector<Foot> feet, expected;
      old.add_minima(d, Vector3::Zero(), 1.5, 1e-7, elements.data(), count, feet);
      fresh.add_minima(d, Vector3::Zero(), 1.5, 1e-7, elements.data(), count, expected);
      expect_same_feet(feet, expected);
      const SurfacePoint from{k % 8, {0.3, 0.6}};
      expect_same(old.follow(d, from, Vector3::Zero()), fresh.follow(d, from, Vector3::Zero()));
    }
  }
}

}  // namespace
}  // namespace search
