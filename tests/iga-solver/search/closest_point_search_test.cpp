// SPDX-License-Identifier: GPL-2.0-or-later
// Closest points on random surfaces against a search by nested grids, which knows no derivative.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "feet.h"
#include "nurbs/refinement.h"
#include "nurbs/shapes.h"
#include "search/surface_tree.h"

namespace search {
namespace {

using namespace nurbs;

double distance_at(const Surface& surface, const Vector3& d, const Parameter<2>& xi) {
  return (interpolate(surface.space, surface.control_points, xi) - d).norm();
}

// Moves a grid of 7 x 7 points to its best one and shrinks it, unless that lies on the rim, down to
// round-off.
double zoom(const Surface& surface, const Vector3& d, Parameter<2> centre, Parameter<2> half_width) {
  double least = distance_at(surface, d, centre);
  const double smallest = 1e-13 * half_width[0];
  while (half_width[0] > smallest) {
    const Parameter<2> middle = centre;
    bool on_rim = false;
    for (int k = 0; k < 49; ++k) {
      const int step[2] = {k % 7 - 3, k / 7 - 3};
      Parameter<2> xi;
      for (int i = 0; i < 2; ++i)
        xi[i] = std::clamp(middle[i] + step[i] * half_width[i] / 3.0, surface.space.knots(i).front(),
                           surface.space.knots(i).back());
      const double distance = distance_at(surface, d, xi);
      if (distance >= least) continue;
      least = distance, centre = xi;
      on_rim = std::max(std::abs(step[0]), std::abs(step[1])) == 3;
    }
    if (!on_rim)
      for (double& width : half_width) width *= 0.5;
  }
  return least;
}

// Least distance: a dense grid, then a zoom from the best few of its local minima.
double brute_force_distance(const Surface& surface, const Vector3& d) {
  constexpr int n = 48;
  std::vector<double> grid((n + 1) * (n + 1));
  const auto parameter = [&](int k) {
    const Parameter<2> t{static_cast<double>(k % (n + 1)) / n, static_cast<double>(k / (n + 1)) / n};
    Parameter<2> xi;
    for (int i = 0; i < 2; ++i) {
      const KnotVector& knots = surface.space.knots(i);
      xi[i] = knots.front() + t[i] * (knots.back() - knots.front());
    }
    return xi;
  };
  std::vector<int> minima;
  for (size_t k = 0; k < grid.size(); ++k) grid[k] = distance_at(surface, d, parameter(k));
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      bool least = true;
      for (int jj = std::max(j - 1, 0); jj <= std::min(j + 1, n); ++jj)
        for (int ii = std::max(i - 1, 0); ii <= std::min(i + 1, n); ++ii)
          least = least && grid[i + (n + 1) * j] <= grid[ii + (n + 1) * jj];
      if (least) minima.push_back(i + (n + 1) * j);
    }
  std::sort(minima.begin(), minima.end(), [&](int a, int b) { return grid[a] < grid[b]; });
  if (minima.size() > 6) minima.resize(6);
  double least = grid[minima.front()];
  Parameter<2> half_width;
  for (int i = 0; i < 2; ++i)
    half_width[i] = 1.5 * (surface.space.knots(i).back() - surface.space.knots(i).front()) / n;
  for (int k : minima) least = std::min(least, zoom(surface, d, parameter(k), half_width));
  return least;
}

void expect_nearest(const Surface& surface, shapes::Random& random, int points) {
  for (int k = 0; k < points; ++k) {
    const Vector3 d = shapes::point_near_square(random);
    const Foot p = closest(surface, d);
    EXPECT_NEAR(p.distance, brute_force_distance(surface, d), 1e-11) << "d = " << d.transpose();
    EXPECT_NE(p.status, FootStatus::not_converged);
    EXPECT_NEAR(p.distance, distance_at(surface, d, p.xi), 1e-14);
  }
}

TEST(ClosestPointSearch, SmoothHills) {
  shapes::Random random(11);
  for (int degree = 2; degree <= 6; ++degree)
    for (const bool rational : {false, true})
      expect_nearest(
          shapes::random_hills(
              random, {KnotVector::uniform(degree, 5), KnotVector::from_breaks(degree, {0, .1, .4, 1})}, 0.3,
              rational),
          random, 12);
}

TEST(ClosestPointSearch, CreasesAndRepeatedKnots) {
  shapes::Random random(12);
  for (int degree = 1; degree <= 4; ++degree)
    for (int k = 0; k < 3; ++k)
      expect_nearest(
          shapes::random_hills(
              random, {shapes::random_knots(random, degree, 4), shapes::random_knots(random, 1 + k, 4)}, 0.3,
              true),
          random, 12);
}

// A collapsed edge: the pole of a random tent.
TEST(ClosestPointSearch, Poles) {
  shapes::Random random(13);
  for (int k = 0; k < 3; ++k) {
    Surface tent =
        shapes::random_hills(random, {KnotVector::uniform(3, 4), KnotVector::uniform(2, 4)}, 0.2, true);
    const int n = tent.space.control_point_count(0);
    for (int i = 0; i < n; ++i) tent.control_points.col(i) = tent.control_points.col(0);
    expect_nearest(tent, random, 20);
  }
}

// The candidates of a tree are enough: the same foot as with all elements, for points within reach.
TEST(ClosestPointSearch, CandidatesOfATree) {
  shapes::Random random(14);
  const Surface hills =
      shapes::random_hills(random, {KnotVector::uniform(2, 12), KnotVector::uniform(2, 9)}, 0.2, true);
  SurfaceTree tree(hills.space);
  tree.refit(hills.control_points);
  const SurfaceProjector projector(hills.space, hills.control_points);
  std::vector<int> candidates;
  int within_reach = 0;
  for (int k = 0; k < 500; ++k) {
    const Vector3 d = shapes::point_near_square(random);
    const Foot p = closest(hills, d);
    constexpr double reach = 0.2;
    if (p.distance > reach) continue;
    ++within_reach;
    candidates.clear();
    tree.query(d, reach, 0, candidates);
    ASSERT_FALSE(candidates.empty());
    const Foot q = projector.cold_on(d, candidates.data(), static_cast<int>(candidates.size()));
    EXPECT_NEAR(q.distance, p.distance, 1e-14);
  }
  EXPECT_GT(within_reach, 50);
}

// A point led over smooth hills nearer than their radius of curvature: the foot followed by warm starts is
// the one found from scratch, everywhere, and costs a few iterations only.
TEST(ClosestPointSearch, WarmStartsFollow) {
  shapes::Random random(15);
  const Surface hills =
      shapes::random_hills(random, {KnotVector::uniform(2, 8), KnotVector::uniform(3, 8)}, 0.005, true);
  const SurfaceProjector projector(hills.space, hills.control_points);
  Parameter<2> xi = projector.cold({0.5, 0.5, 0.08}).xi;
  constexpr int steps = 2000;
  int most = 0;
  for (int step = 0; step < steps; ++step) {
    const double t = 2 * M_PI * step / steps;
    const Vector3 d(0.5 + 0.6 * std::sin(3 * t), 0.5 + 0.6 * std::sin(2 * t), 0.08);  // beyond the edges, too
    const Foot warm = projector.warm(d, xi);
    EXPECT_NEAR(warm.distance, projector.cold(d).distance, 1e-14) << step;
    xi = warm.xi;
    most = std::max(most, warm.iterations);
  }
  EXPECT_LE(most, 8);
}

}  // namespace
}  // namespace search
