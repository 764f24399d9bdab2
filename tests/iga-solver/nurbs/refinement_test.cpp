// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/refinement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nurbs/shapes.h"

namespace nurbs {
namespace {

template <int Dim>
void expect_same_geometry(const Patch<Dim>& a, const Patch<Dim>& b, shapes::Random& random) {
  check_patch(b);
  for (int k = 0; k < 100; ++k) {
    const Parameter<Dim> xi = shapes::random_parameter(random, a.space);
    const double difference =
        (interpolate(a.space, a.control_points, xi) - interpolate(b.space, b.control_points, xi)).norm();
    EXPECT_LE(difference, 1e-13);
  }
}

int multiplicity(const KnotVector& knots, double xi) {
  return static_cast<int>(std::count(knots.knots().begin(), knots.knots().end(), xi));
}

template <int Dim>
void check_insertion(unsigned seed) {
  shapes::Random random(seed);
  for (const bool rational : {false, true})
    for (int direction = 0; direction < Dim; ++direction) {
      const Patch<Dim> patch = shapes::random_patch<Dim>(random, Dim == 3 ? 4 : 6, 3, rational);
      const KnotVector& knots = patch.space.knots(direction);
      // A new knot, up to C0 at once; then an old one, up to C0 one by one.
      const double fresh = shapes::uniform(random, knots.front(), knots.back()), old = knots.breaks()[1];
      Patch<Dim> refined = insert_knot(patch, direction, fresh, knots.degree());
      EXPECT_EQ(multiplicity(refined.space.knots(direction), fresh), knots.degree());
      expect_same_geometry(patch, refined, random);
      for (int m = multiplicity(knots, old); m < knots.degree(); ++m) {
        refined = insert_knot(refined, direction, old);
        EXPECT_EQ(multiplicity(refined.space.knots(direction), old), m + 1);
        expect_same_geometry(patch, refined, random);
      }
      EXPECT_THROW(insert_knot(refined, direction, old), std::invalid_argument);
    }
}

template <int Dim>
void check_elevation(unsigned seed) {
  shapes::Random random(seed);
  for (const bool rational : {false, true})
    for (int direction = 0; direction < Dim; ++direction) {
      const Patch<Dim> patch = shapes::random_patch<Dim>(random, 3, 3, rational);
      const KnotVector& knots = patch.space.knots(direction);
      for (int times = 1; knots.degree() + times <= (Dim == 3 ? 5 : kMaxDegree); ++times) {
        const Patch<Dim> elevated = elevate_degree(patch, direction, times);
        EXPECT_EQ(elevated.space.degree(direction), knots.degree() + times);
        EXPECT_EQ(elevated.space.knots(direction).breaks(), knots.breaks());
        for (double xi : knots.breaks())
          EXPECT_EQ(multiplicity(elevated.space.knots(direction), xi), multiplicity(knots, xi) + times);
        expect_same_geometry(patch, elevated, random);
      }
      EXPECT_THROW(elevate_degree(patch, direction, kMaxDegree), std::invalid_argument);
    }
}

TEST(Refinement, InsertionKeepsCurves) { check_insertion<1>(1); }
TEST(Refinement, InsertionKeepsSurfaces) { check_insertion<2>(2); }
TEST(Refinement, InsertionKeepsVolumes) { check_insertion<3>(3); }
TEST(Refinement, ElevationKeepsCurves) { check_elevation<1>(4); }
TEST(Refinement, ElevationKeepsSurfaces) { check_elevation<2>(5); }
TEST(Refinement, ElevationKeepsVolumes) { check_elevation<3>(6); }

// A Bezier curve split in its middle: de Casteljau's points, known by hand.
TEST(Refinement, SplitsABezierCurve) {
  const Curve parabola{Space<1>({KnotVector::uniform(2, 1)}),
                       (NodalVectors(3, 3) << 0, 1, 2, 0, 2, 0, 0, 0, 0).finished()};
  const Curve split = insert_knot(parabola, 0, 0.5, 2);
  const NodalVectors expected =
      (NodalVectors(3, 5) << 0, .5, 1, 1.5, 2, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0).finished();
  EXPECT_EQ(split.control_points, expected);
}

// A very uneven mesh must not lose digits: all factors of the rule are between 0 and 1.
TEST(Refinement, StaysAccurateOnStronglyGradedMeshes) {
  shapes::Random random(7);
  Curve curve{Space<1>({KnotVector::from_breaks(4, {0, 1e-6, 1e-3, 0.2, 0.2001, 1})}), {}};
  curve.control_points = NodalVectors::Random(3, curve.space.control_point_count());
  expect_same_geometry(curve, insert_knot(curve, 0, 0.20005, 3), random);
  expect_same_geometry(curve, elevate_degree(curve, 0, 2), random);
}

TEST(Refinement, RefusesBadArguments) {
  shapes::Random random(8);
  const Surface surface = shapes::random_patch<2>(random, 2, 2, false);
  const auto message = [](auto refine) -> std::string {
    try {
      refine();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  for (double outside : {0.0, surface.space.knots(0).back(), -0.1, double(NAN)})
    EXPECT_THAT(message([&] { insert_knot(surface, 0, outside); }),
                testing::HasSubstr("is outside, expected one"));
  EXPECT_EQ(message([&] { insert_knot(surface, 2, 0.1); }), "direction is 2, expected 0 to 1");
  EXPECT_EQ(message([&] { elevate_degree(surface, -1); }), "direction is -1, expected 0 to 1");
  EXPECT_EQ(message([&] { elevate_degree(surface, 0, -1); }), "times is -1, expected 0 or more");
}

}  // namespace
}  // namespace nurbs
