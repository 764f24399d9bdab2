// SPDX-License-Identifier: GPL-2.0-or-later
// The judge judged: distances and local conditions with closed forms.
#include "distance_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "nurbs/shapes.h"

namespace nurbs::judge {
namespace {

constexpr double kQuarterTurn = M_PI / 2;
constexpr double kTolerance = 1e-10;

void expect_distance(const Surface& surface, const Vector3& d, double expected) {
  const DistanceBound bound(surface);
  const Nearest found = bound.nearest(d, kTolerance);
  EXPECT_NEAR(found.distance, expected, kTolerance * expected + 1e-14) << "d = " << d.transpose();
  EXPECT_NEAR((bound.point(found.xi) - d).norm(), found.distance, 1e-13);
  // A claim that is too large by 1e-9 is refuted; the truth is not.
  const Nearest claim{found.xi, expected * (1.0 + 1e-9), 0}, truth{found.xi, expected, 0};
  EXPECT_LT(bound.nearest(d, claim, kTolerance).distance, claim.distance);
  EXPECT_GE(bound.nearest(d, truth, kTolerance).distance, expected * (1.0 - kTolerance));
}

Surface refined_unevenly(Surface surface) {
  surface = elevate_degree(elevate_degree(surface, 0), 1);
  for (const double knot : {.1, .3, .4, .85})
    surface = insert_knot(insert_knot(surface, 0, knot), 1, knot, knot == .3 ? 2 : 1);
  return surface;
}

TEST(DistanceBound, CylinderInsideOutsideAndBeyondItsEdges) {
  const Surface cylinder = shapes::revolve(shapes::line(10.0, 20.0), kQuarterTurn);
  for (const Surface& surface : {cylinder, refined_unevenly(cylinder)}) {
    expect_distance(surface, {9, 7, 5}, std::hypot(9, 7) - 10);
    expect_distance(surface, {2, 1, 4}, 10 - std::hypot(2, 1));
    expect_distance(surface, {12, -1, 3}, std::hypot(2, 1));
    expect_distance(surface, {5, 9, 21}, std::hypot(std::hypot(5, 9) - 10, 1));
    expect_distance(surface, {11, -1, -1}, std::sqrt(3.0));
    expect_distance(surface, {0, 0, 7}, 10.0);  // equally far from a whole arc
  }
}

TEST(DistanceBound, SphereWithPoleAndTorus) {
  const Surface octant = refined_unevenly(shapes::revolve(shapes::quarter_arc(0.0, 5.0), kQuarterTurn));
  expect_distance(octant, {3, 4, 2}, std::sqrt(29.0) - 5);
  expect_distance(octant, {0, 0, 7}, 2.0);
  expect_distance(octant, {.3, .4, 5.2}, std::hypot(.5, 5.2) - 5);
  const Surface torus = refined_unevenly(shapes::revolve(shapes::quarter_arc(10.0, 3.0), kQuarterTurn));
  expect_distance(torus, {9, 9, 2}, std::abs(std::hypot(std::hypot(9, 9) - 10, 2) - 3));
}

// z = height x (1 - x) of Bezier degree 2 on the unit square.
Surface arch(double height) {
  Surface arch =
      plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {KnotVector::uniform(2, 1), KnotVector::uniform(2, 1)});
  for (const int a : {1, 4, 7}) arch.control_points(2, a) = 0.5 * height;
  return arch;
}

// phi = |S - d|^2 / 2 below the crest of z = h x (1 - x): phi_xx = 1 - 2 h (depth); lengths of the net: 1
// across.
TEST(DistanceBound, ConditionsOfMinimumSaddleAndSlope) {
  const DistanceBound bound(arch(0.4));
  const double crest = 0.1;
  const auto at_crest = [&](double depth) { return bound.conditions({0.5, 0.5, crest - depth}, {0.5, 0.5}); };
  EXPECT_NEAR(at_crest(0.5).slope, 0.0, 1e-15);
  EXPECT_GT(at_crest(1.0).curvature, 0.1);
  EXPECT_NEAR(at_crest(1.25).curvature, 0.0, 1e-14);
  EXPECT_LT(at_crest(1.5).curvature, -0.1);
  EXPECT_LT(bound.conditions({0.5, 0.6, 0.3}, {0.5, 0.5}).slope, -0.09);
}

TEST(DistanceBound, ConditionsOnBordersLookInsideOnly) {
  const DistanceBound bound(arch(0.0));
  const LocalConditions beyond = bound.conditions({-0.3, 0.5, 0.1}, {0.0, 0.5});
  EXPECT_GE(beyond.slope, 0.0);
  EXPECT_NEAR(bound.conditions({0.3, 0.5, 0.1}, {0.0, 0.5}).slope, -0.3, 1e-14);
  EXPECT_NEAR(bound.conditions({-0.3, -0.4, 0.0}, {0.0, 0.0}).slope, 0.3, 1e-14);  // a corner, along its edge
}

// On a pole all directions count: at the tip of an octant only points on the axis have their foot.
TEST(DistanceBound, ConditionsOnAPole) {
  const DistanceBound bound(shapes::revolve(shapes::quarter_arc(0.0, 5.0), kQuarterTurn));
  for (const double xi : {0.0, 0.5, 1.0}) {
    EXPECT_NEAR(bound.conditions({0, 0, 7}, {xi, 1.0}).slope, 0.0, 1e-14);
    EXPECT_NEAR(bound.conditions({0.5, 0.0, 7}, {xi, 1.0}).slope, 0.5 * (std::sqrt(2.0) - 2.0), 1e-14);
  }
}

}  // namespace
}  // namespace nurbs::judge
