// SPDX-License-Identifier: GPL-2.0-or-later
// The paper's local search: its feet against feet known by construction and against Newton
// (surface_projector.h).
#include "search/simplex_brent.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

#include "feet.h"
#include "nurbs/bezier_element.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

using Status = FootStatus;

// Inside the element and, where polynomials go on, a little outside.
TEST(BezierElement, EqualsTheSurface) {
  shapes::Random random(5);
  for (int k = 0; k < 50; ++k) {
    const auto surface = shapes::random_patch<2>(random, kMaxDegree, 3, k % 2 == 0);
    for (int e = 0; e < surface.space.element_count(); ++e) {
      BezierElement element;
      element.fetch(surface.space, surface.control_points, e);
      const Indices<2> indices = surface.space.element_indices(e);
      const double t[2] = {shapes::uniform(random, -0.1, 1.1), shapes::uniform(random, -0.1, 1.1)};
      Parameter<2> xi;
      for (int i = 0; i < 2; ++i) {
        const double* knot = &surface.space.knots(i).breaks()[indices[i]];
        xi[i] = knot[0] + t[i] * (knot[1] - knot[0]);
      }
      const bool inside = std::min(t[0], t[1]) >= 0.0 && std::max(t[0], t[1]) <= 1.0;
      EXPECT_EQ(element.holds(xi), inside);
      RationalBasis<2> basis;
      evaluate_on_element(surface.space, e, xi, 1, basis);
      for (int j = 0; j < 2; ++j) {
        const BezierElement::PointAndTangent at = element.evaluate(xi, j);
        Vector3 S_j = Vector3::Zero();
        for (int a = 0; a < basis.count; ++a)
          S_j += basis.dR[j][a] * surface.control_points.col(basis.control_point[a]);
        EXPECT_LT((at.S - interpolate(basis, surface.control_points)).norm(), 1e-11);
        EXPECT_LT((at.S_j - S_j).norm(), 1e-10 * (1.0 + S_j.norm()));
      }
    }
  }
}

Vector3 unit_normal(const Surface& surface, const Parameter<2>& xi) {
  RationalBasis<2> basis;
  evaluate(surface.space, xi, 1, basis);
  Vector3 S_i[2] = {Vector3::Zero(), Vector3::Zero()};
  for (int a = 0; a < basis.count; ++a)
    for (int i = 0; i < 2; ++i) S_i[i] += basis.dR[i][a] * surface.control_points.col(basis.control_point[a]);
  return S_i[0].cross(S_i[1]).normalized();
}

Foot paper(const Surface& surface, const Vector3& d, const Parameter<2>& guess, bool warm) {
  return closest_point_simplex_brent(surface.space, surface.control_points, d, guess, warm);
}

Surface hills(shapes::Random& random, int degree, bool rational, double height = 0.05) {
  const KnotVector knots = KnotVector::uniform(degree, 6);
  return shapes::random_hills(random, {knots, knots}, height, rational);
}

// Points at a small height over random feet, well inside; guesses off by up to `off` in both parameters.
struct Trial {
  Parameter<2> xi, guess;
  Vector3 d;
};
Trial trial(shapes::Random& random, const Surface& surface, double off) {
  Trial t;
  for (int i = 0; i < 2; ++i) {
    t.xi[i] = shapes::uniform(random, 0.2, 0.8);
    t.guess[i] = t.xi[i] + shapes::uniform(random, -off, off);
  }
  t.d = interpolate(surface.space, surface.control_points, t.xi) +
        shapes::uniform(random, -0.02, 0.02) * unit_normal(surface, t.xi);
  return t;
}

// Converged feet are stationary minima; with so small a height the one near the guess is the foot itself.
// Returns the share that converged.
double expect_interior_feet(bool warm, double off) {
  shapes::Random random(7);
  int converged = 0, trials = 0;
  for (int degree = 2; degree <= 5; ++degree)
    for (bool rational : {false, true}) {
      const Surface surface = hills(random, degree, rational);
      for (int k = 0; k < 100; ++k, ++trials) {
        const Trial t = trial(random, surface, off);
        const Foot p = paper(surface, t.d, t.guess, warm);
        if (p.status != Status::interior) continue;
        ++converged;
        const Foot newton = closest_from(surface, t.d, p.xi);  // confirms it stays there
        for (int i = 0; i < 2; ++i) {
          EXPECT_NEAR(p.xi[i], t.xi[i], 1e-10) << "degree " << degree << ", trial " << k;
          EXPECT_NEAR(p.xi[i], newton.xi[i], 1e-10);
        }
        EXPECT_NEAR(p.distance, newton.distance, 1e-10);
        EXPECT_NEAR(p.distance, (t.d - p.point).norm(), 1e-15);
      }
    }
  return static_cast<double>(converged) / trials;
}

TEST(SimplexBrent, WarmFeetAreThoseOfNewton) { EXPECT_EQ(expect_interior_feet(true, 0.02), 1.0); }
TEST(SimplexBrent, GuessesThatAreTheFootAreKept) { EXPECT_EQ(expect_interior_feet(true, 0.0), 1.0); }
TEST(SimplexBrent, ColdFeetAreThoseOfNewton) { EXPECT_GT(expect_interior_feet(false, 0.3), 0.99); }

// The triangle needs room: from every corner of the patch it has to start inward.
TEST(SimplexBrent, ColdFromCorners) {
  shapes::Random random(12);
  const Surface surface = hills(random, 2, false, 0.12);
  for (int k = 0; k < 20; ++k) {
    const Trial t = trial(random, surface, 0.0);
    for (const Parameter<2>& corner : {Parameter<2>{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
      const Foot p = paper(surface, t.d, corner, false);
      ASSERT_EQ(p.status, Status::interior);
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(p.xi[i], t.xi[i], 1e-10);
    }
  }
}

// Several minima: the nearest of all.
TEST(SimplexBrent, BestOfElementsIsTheNearest) {
  shapes::Random random(8);
  int converged = 0;
  for (int k = 0; k < 100; ++k) {
    const Surface surface = hills(random, 2, false, 0.3);
    std::vector<int> elements(surface.space.element_count());
    std::iota(elements.begin(), elements.end(), 0);
    const int count = static_cast<int>(elements.size());
    const Vector3 d(shapes::uniform(random, 0.2, 0.8), shapes::uniform(random, 0.2, 0.8), 0.3);
    const Foot p = closest_point_simplex_brent_on_elements(surface.space, surface.control_points, d,
                                                           elements.data(), count);
    if (p.status != Status::interior) continue;
    ++converged;
    const Foot newton = closest(surface, d);
    EXPECT_NEAR(p.distance, newton.distance, 1e-12);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(p.xi[i], newton.xi[i], 1e-10);
  }
  EXPECT_GE(converged, 20);
  const Surface surface = hills(random, 2, false);
  EXPECT_THROW(
      closest_point_simplex_brent_on_elements(surface.space, surface.control_points, {0, 0, 0}, nullptr, 0),
      std::invalid_argument);
}

// "By employing this initial estimation, the Brent method usually converges in five iterations or less."
TEST(SimplexBrent, WarmIterationsAlongAPath) {
  shapes::Random random(9);
  const Surface surface = hills(random, 2, false);
  for (double travel : {0.001, 0.01, 0.1}) {  // per step, in elements
    const int steps = static_cast<int>(3.6 / travel);
    Parameter<2> guess = {0.2, 0.2};
    long sum = 0;
    int largest = 0;
    for (int n = 0; n <= steps; ++n) {
      const double s = static_cast<double>(n) / steps;
      const Parameter<2> xi = {0.2 + 0.6 * s, 0.5 - 0.3 * std::cos(3.0 * s)};
      const Vector3 d = interpolate(surface.space, surface.control_points, xi) +
                        0.02 * std::cos(20.0 * s) * unit_normal(surface, xi);
      const Foot p = paper(surface, d, guess, n > 0);
      ASSERT_EQ(p.status, Status::interior) << "step " << n;
      for (int i = 0; i < 2; ++i) ASSERT_NEAR(p.xi[i], xi[i], 1e-10) << "step " << n;
      guess = p.xi;
      sum += p.iterations;
      largest = std::max(largest, p.iterations);
    }
    const double mean = static_cast<double>(sum) / (steps + 1);
    std::cout << "foot moves by " << travel << " elements a step: Brent takes " << mean
              << " iterations on average, " << largest << " at most\n";
    EXPECT_LE(mean, 5.0);
  }
}

// Eqs. 27-28 have no root there.
TEST(SimplexBrent, DoesNotConvergeBeyondEdgesAndOnCreases) {
  const Surface square =
      plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {KnotVector::uniform(2, 4), KnotVector::uniform(2, 4)});
  Surface roof = plane({-1, 0, 0}, {2, 0, 0}, {0, 1, 0},
                       {KnotVector::from_breaks(1, {0.0, 0.5, 1.0}), KnotVector::uniform(1, 1)});
  for (int a : {1, 4}) roof.control_points(2, a) = 1.0;  // the ridge, x = 0
  for (bool warm : {true, false}) {
    for (const Vector3& d : {Vector3(1.2, 0.5, 0.1), Vector3(-0.1, -0.1, 0.0), Vector3(0.5, 1.0, 0.3)})
      EXPECT_EQ(paper(square, d, {0.6, 0.7}, warm).status, Status::not_converged) << d.transpose();
    const Foot p = paper(roof, {0.1, 0.4, 2.0}, {0.3, 0.6}, warm);
    EXPECT_EQ(p.status, Status::not_converged);
    EXPECT_NEAR(p.distance, (Vector3(0.1, 0.4, 2.0) - p.point).norm(), 1e-15);
  }
}

// From the far side of a tube the distance is largest along the arc, not least.
TEST(SimplexBrent, RefusesStationaryPointsThatAreNoMinimum) {
  const Surface tube = shapes::revolve(shapes::line(1.0, 1.0), M_PI / 2, 2);
  const Vector3 d(0.0, -0.3, 0.5);
  EXPECT_EQ(paper(tube, d, {1.0 - 1e-6, 0.5}, true).status, Status::not_converged);
  const Vector3 near(0.0, 0.3, 0.5);
  EXPECT_EQ(paper(tube, near, {1.0 - 1e-6, 0.5}, true).status, Status::interior);
}

// From far guesses over strong hills Brent may land anywhere; what it reports is a minimum not farther than
// where it started.
TEST(SimplexBrent, NeverEndsFartherThanItStarted) {
  shapes::Random random(10);
  int converged = 0;
  for (int k = 0; k < 3000; ++k) {
    const Surface surface = hills(random, 2, false, 0.3);
    const Parameter<2> guess = shapes::random_parameter(random, surface.space);
    const Vector3 d(shapes::uniform(random, 0, 1), shapes::uniform(random, 0, 1),
                    shapes::uniform(random, -0.3, 0.3));
    const Foot p = paper(surface, d, guess, true);
    if (p.status != Status::interior) continue;
    ++converged;
    const double start = (interpolate(surface.space, surface.control_points, guess) - d).norm();
    EXPECT_LE(p.distance, start);
    const Foot newton = closest_from(surface, d, p.xi);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(p.xi[i], newton.xi[i], 1e-9);
  }
  EXPECT_GT(converged, 300);
}

TEST(SimplexBrent, ScalingLengthsChangesNothing) {
  shapes::Random random(11);
  const Surface surface = hills(random, 3, true);
  const double scale = 1.0 / 1024.0;
  const NodalVectors scaled = scale * surface.control_points;
  for (int k = 0; k < 20; ++k) {
    const Trial t = trial(random, surface, 0.3);
    const Foot p = paper(surface, t.d, t.guess, false);
    const Foot q = closest_point_simplex_brent(surface.space, scaled, scale * t.d, t.guess, false);
    EXPECT_EQ(p.xi, q.xi);
    EXPECT_EQ(p.status, q.status);
    EXPECT_EQ(p.iterations, q.iterations);
  }
}

}  // namespace
}  // namespace search
