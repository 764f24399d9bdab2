// SPDX-License-Identifier: GPL-2.0-or-later
// SurfaceProjector and its elements against the basis functions, the judge and dense samples.
#include "search/surface_projector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "distance_bound.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

std::vector<int> all_elements(const Surface& surface) {
  std::vector<int> elements(surface.space.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  return elements;
}

void expect_on_surface(const Surface& surface, const Vector3& d, const Foot& p) {
  EXPECT_NE(p.status, FootStatus::not_converged);
  EXPECT_NEAR((interpolate(surface.space, surface.control_points, p.xi) - p.point).norm(), 0.0, 1e-12);
  EXPECT_NEAR((p.point - d).norm(), p.distance, 1e-14);
}

// Gradient, metric and Hessian of the power form are those of the basis functions, in all degrees.
TEST(SurfaceProjector, PowerFormIsTheSurface) {
  shapes::Random random(21);
  for (int k = 0; k < 40; ++k) {
    const Surface surface = shapes::random_patch<2>(random, 5, 3, k % 2 == 1);
    const ElementStore elements(surface.space, surface.control_points);
    const Indices<2> e = {k % 3, k % 2};
    const int local[2] = {e[0], e[1]};
    const double s[2] = {shapes::uniform(random, -1, 1), shapes::uniform(random, -1, 1)};
    const Vector3 d = shapes::point_near_square(random);
    const ElementStore::Element element = elements.element(local);
    DistanceJet jet;
    elements.kernel().evaluate(elements.kernel().p, elements.kernel().q, element.row, s, {d[0], d[1], d[2]},
                               jet);

    Parameter<2> xi;
    double h[2];
    for (int i = 0; i < 2; ++i) {
      xi[i] = elements.axis(i, e[i]).parameter(s[i]);
      h[i] = elements.axis(i, e[i]).half_width;
    }
    RationalBasis<2> basis;
    evaluate_on_element(surface.space, surface.space.element_index(e), xi, 2, basis);
    Vector3 r = interpolate(basis, surface.control_points) - d, S_i[2], S_ij[3];
    for (auto* S : {&S_i[0], &S_i[1], &S_ij[0], &S_ij[1], &S_ij[2]}) S->setZero();
    for (int a = 0; a < basis.count; ++a) {
      const Vector3 P = surface.control_points.col(basis.control_point[a]);
      for (int i = 0; i < 2; ++i) S_i[i] += h[i] * basis.dR[i][a] * P;
      for (int ij = 0; ij < 3; ++ij) S_ij[ij] += h[ij / 2] * h[(ij + 1) / 2] * basis.d2R[ij][a] * P;
    }
    EXPECT_NEAR(jet.phi, 0.5 * r.squaredNorm(), 1e-12);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(jet.gradient[i], r.dot(S_i[i]), 1e-11);
    for (int ij = 0; ij < 3; ++ij) {
      const double metric = S_i[ij / 2].dot(S_i[(ij + 1) / 2]);
      EXPECT_NEAR(jet.metric[ij], metric, 1e-10);
      EXPECT_NEAR(jet.hessian[ij], metric + r.dot(S_ij[ij]), 1e-10);
    }
  }
}

// Derivatives by the patch's parameters, of a distance that any foot could have.
TEST(SurfaceProjector, SlopesAreThoseOfTheBasis) {
  shapes::Random random(22);
  for (int k = 0; k < 40; ++k) {
    const Surface surface = shapes::random_patch<2>(random, 5, 3, k % 2 == 1);
    const SurfaceProjector projector(surface.space, surface.control_points);
    const Parameter<2> xi = shapes::random_parameter(random, surface.space);
    const Vector3 delta = shapes::point_near_square(random);
    RationalBasis<2> basis;
    evaluate(surface.space, xi, 2, basis);
    Eigen::Matrix<double, 3, 2> S_i = Eigen::Matrix<double, 3, 2>::Zero();
    Eigen::Matrix2d bend = Eigen::Matrix2d::Zero();
    for (int a = 0; a < basis.count; ++a) {
      const Vector3 P = surface.control_points.col(basis.control_point[a]);
      for (int i = 0; i < 2; ++i) {
        S_i.col(i) += basis.dR[i][a] * P;
        for (int j = 0; j < 2; ++j) bend(i, j) += basis.d2R[i + j][a] * delta.dot(P);
      }
    }
    const SurfaceProjector::Slopes slopes = projector.slopes(xi, delta);
    EXPECT_LT((slopes.S_i - S_i).norm(), 1e-12 * (1.0 + S_i.norm())) << k;
    EXPECT_LT((slopes.hessian - (S_i.transpose() * S_i - bend)).norm(), 1e-10 * (1.0 + bend.norm())) << k;
  }
}

// Nothing the judge finds, and nothing on a dense grid, is nearer than a cold result.
TEST(SurfaceProjector, ColdIsTheNearest) {
  shapes::Random random(22);
  for (int k = 0; k < 40; ++k) {
    Surface surface = shapes::random_patch<2>(random, 5, 1 + k % 4, k % 3 > 0);
    if (k % 10 == 4)  // a pole
      for (int i = 0; i < surface.space.control_point_count(0); ++i)
        surface.control_points.col(i) = surface.control_points.col(0);
    const SurfaceProjector projector(surface.space, surface.control_points);
    const judge::DistanceBound bound(surface);
    const std::vector<int> elements = all_elements(surface);
    for (int trial = 0; trial < 5; ++trial) {
      const Vector3 d = shapes::point_near_square(random);
      const Foot cold = projector.cold(d);
      expect_on_surface(surface, d, cold);
      const judge::Nearest least = bound.nearest(d, {cold.xi, cold.distance, 0}, 1e-9);
      EXPECT_LE(cold.distance, least.distance * (1 + 1e-9) + bound.round_off());
      double grid = cold.distance;
      for (int sample = 0; sample < 400; ++sample)
        grid = std::min(grid, (interpolate(surface.space, surface.control_points,
                                           shapes::random_parameter(random, surface.space)) -
                               d)
                                  .norm());
      EXPECT_LE(cold.distance, grid * (1 + 1e-9));
      const Foot candidates = projector.cold_on(d, elements.data(), static_cast<int>(elements.size()));
      EXPECT_NEAR(candidates.distance, cold.distance, 1e-9 * cold.distance);
      const Foot nearest = projector.nearest(d, shapes::random_parameter(random, surface.space));
      EXPECT_NEAR(nearest.distance, cold.distance, 1e-9 * cold.distance);
    }
  }
}

// Every minimum that warm starts from everywhere run into is listed, once, the nearest first.
TEST(SurfaceProjector, AllMinimaHoldsEveryWarmResult) {
  shapes::Random random(23);
  std::vector<Foot> minima;
  for (int k = 0; k < 20; ++k) {
    const Surface surface = shapes::random_patch<2>(random, 4, 1 + k % 3, k % 2 > 0);
    const SurfaceProjector projector(surface.space, surface.control_points);
    const Vector3 d = shapes::point_near_square(random);
    const double nearest = projector.cold(d).distance, reach = 1.5 * nearest;
    projector.all_minima(d, reach, minima);
    ASSERT_FALSE(minima.empty());
    EXPECT_NEAR(minima[0].distance, nearest, 1e-9 * nearest);
    for (size_t i = 1; i < minima.size(); ++i) {
      EXPECT_GE(minima[i].distance, minima[i - 1].distance);
      EXPECT_GT((minima[i].point - minima[i - 1].point).norm(), 1e-8);
    }
    for (int trial = 0; trial < 60; ++trial) {
      const Foot warm = projector.warm(d, shapes::random_parameter(random, surface.space));
      expect_on_surface(surface, d, warm);
      if (warm.distance > reach * (1 - 1e-9)) continue;
      EXPECT_TRUE(std::any_of(minima.begin(), minima.end(),
                              [&](const Foot& p) { return (p.point - warm.point).norm() < 1e-6; }))
          << "d = " << d.transpose() << ", distance " << warm.distance;
    }
  }
}

// Elements and boxes follow the control points; a shift moves the feet and nothing else.
TEST(SurfaceProjector, FollowsMovedControlPoints) {
  shapes::Random random(24);
  Surface hills =
      shapes::random_hills(random, {KnotVector::uniform(2, 8), KnotVector::uniform(3, 8)}, 0.1, true);
  SurfaceProjector projector(hills.space, hills.control_points);
  const Vector3 d(0.4, 0.6, 0.3), shift(512.0, -1024.0, 256.0);
  const Foot before = projector.cold(d);
  hills.control_points.colwise() += shift;
  projector.surface_moved();
  for (const Foot& p : {projector.cold(d + shift), projector.warm(d + shift, before.xi)}) {
    EXPECT_NEAR(p.distance, before.distance, 1e-12);
    EXPECT_NEAR((p.point - shift - before.point).norm(), 0.0, 1e-11);
  }
}

// From a crease, or from little beside it, a descent goes on in the element where it leads downhill.
TEST(SurfaceProjector, StartsBesideACrease) {
  const Surface pipe = shapes::revolve(shapes::line(1.0, 5.0), 0.5 * kPi, 4);
  const SurfaceProjector projector(pipe.space, pipe.control_points);
  for (const double angle : {-0.4, 0.4})  // from the crease that is at 2
    for (double beside = 1e-16; beside < 0.01; beside *= 1.5)
      for (const double xi : {2.0 - beside, 2.0 + beside})
        for (const double height : {0.1, 0.4, 0.8}) {
          const Vector3 d(-1.7 * std::cos(angle), -1.7 * std::sin(angle), 2.0);
          const Foot foot = projector.warm(d, {xi, height});
          EXPECT_NEAR(foot.distance, 0.7, 1e-14) << angle << ", from " << xi - 2.0;
        }
}

TEST(SurfaceProjector, WrongArguments) {
  shapes::Random random(25);
  const Surface hills =
      shapes::random_hills(random, {KnotVector::uniform(2, 2), KnotVector::uniform(2, 2)}, 0.1, false);
  const NodalVectors few = NodalVectors::Zero(3, 5);
  EXPECT_THROW(SurfaceProjector(hills.space, few), std::invalid_argument);
  const SurfaceProjector projector(hills.space, hills.control_points);
  EXPECT_THROW(projector.cold_on({0, 0, 0}, nullptr, 0), std::invalid_argument);
  const Foot p = projector.cold({0, 0, std::nan("")});
  EXPECT_EQ(p.status, FootStatus::not_converged);
}

}  // namespace
}  // namespace search
