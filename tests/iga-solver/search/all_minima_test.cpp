// SPDX-License-Identifier: GPL-2.0-or-later
// All local minima of the distance against a dense grid whose minima are refined by ever smaller grids: a
// search that knows no derivative.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "distance_bound.h"
#include "nurbs/refinement.h"
#include "nurbs/shapes.h"
#include "search/surface_projector.h"

namespace search {
namespace {

using namespace nurbs;

using shapes::Random;
using shapes::uniform;

struct Minimum {
  Vector3 foot;
  double distance;
};

class BruteForce {
 public:
  BruteForce(const Surface& surface, const Vector3& d) : surface_(surface), d_(d) {
    for (int i = 0; i < 2; ++i) {
      const KnotVector& knots = surface.space.knots(i);
      low_[i] = knots.front();
      step_[i] = (knots.back() - knots.front()) / kPoints;
    }
  }

  // Each once, nearest first.
  std::vector<Minimum> minima_within(double reach) const {
    std::vector<double> grid((kPoints + 1) * (kPoints + 1));
    for (int k = 0; k < static_cast<int>(grid.size()); ++k) grid[k] = distance(parameter(k));
    std::vector<Minimum> minima;
    for (int k = 0; k < static_cast<int>(grid.size()); ++k) {
      if (!least_of_neighbours(grid, k)) continue;
      const Minimum m = refine(parameter(k));
      const bool known = std::any_of(minima.begin(), minima.end(), [&](const Minimum& other) {
        return (other.foot - m.foot).norm() < 1e-5;
      });
      if (!known && m.distance < reach) minima.push_back(m);
    }
    std::sort(minima.begin(), minima.end(),
              [](const Minimum& a, const Minimum& b) { return a.distance < b.distance; });
    return minima;
  }

 private:
  static constexpr int kPoints = 96;

  Parameter<2> parameter(int k) const {
    return {low_[0] + step_[0] * (k % (kPoints + 1)), low_[1] + step_[1] * (k / (kPoints + 1))};
  }
  double distance(const Parameter<2>& xi) const {
    return (interpolate(surface_.space, surface_.control_points, xi) - d_).norm();
  }
  static bool least_of_neighbours(const std::vector<double>& grid, int k) {
    const int column = k % (kPoints + 1), row = k / (kPoints + 1);
    for (int j = std::max(row - 1, 0); j <= std::min(row + 1, kPoints); ++j)
      for (int i = std::max(column - 1, 0); i <= std::min(column + 1, kPoints); ++i)
        if (grid[i + (kPoints + 1) * j] < grid[k]) return false;
    return true;
  }
  // Moves a grid of 7 x 7 points to its best one, and shrinks it unless that lies on its rim.
  Minimum refine(Parameter<2> centre) const {
    double least = distance(centre);
    for (double width = 1.0; width > 1e-9;) {
      const Parameter<2> middle = centre;
      bool on_rim = false;
      for (int k = 0; k < 49; ++k) {
        const int offset[2] = {k % 7 - 3, k / 7 - 3};
        Parameter<2> xi;
        for (int i = 0; i < 2; ++i)
          xi[i] = std::clamp(middle[i] + offset[i] * width * step_[i] / 3.0, low_[i],
                             low_[i] + kPoints * step_[i]);
        const double trial = distance(xi);
        if (trial >= least) continue;
        least = trial, centre = xi;
        on_rim = std::max(std::abs(offset[0]), std::abs(offset[1])) == 3;
      }
      if (!on_rim) width *= 0.5;
    }
    return {interpolate(surface_.space, surface_.control_points, centre), least};
  }

  const Surface& surface_;
  Vector3 d_;
  double low_[2], step_[2];
};

// At random points of a box: nothing that brute force finds is overlooked, and what else is found (in basins
// that fall through the grid) fulfils the conditions of a minimum.  With and without a tree.  Returns the
// number of points with several minima.
int expect_all_minima(const Surface& surface, const Vector3& low, const Vector3& high, double reach) {
  constexpr int kPoints = 40;
  Random random(31);
  const SurfaceProjector projector(surface.space, surface.control_points);
  const judge::DistanceBound bound(surface);
  std::vector<int> elements(surface.space.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  std::vector<Foot> found, found_on;
  int several = 0;
  for (int k = 0; k < kPoints; ++k) {
    const Vector3 d(uniform(random, low[0], high[0]), uniform(random, low[1], high[1]),
                    uniform(random, low[2], high[2]));
    SCOPED_TRACE(testing::Message() << "d = " << d.transpose());
    projector.all_minima(d, reach, found);
    projector.all_minima_on(d, reach, elements.data(), static_cast<int>(elements.size()), found_on);
    EXPECT_EQ(found_on.size(), found.size());
    for (size_t m = 0; m < std::min(found.size(), found_on.size()); ++m)
      EXPECT_NEAR(found_on[m].distance, found[m].distance, 1e-13);
    for (const Minimum& m : BruteForce(surface, d).minima_within(reach)) {
      const auto same = [&](const Foot& p) {
        return std::abs(p.distance - m.distance) < 1e-12 && (p.point - m.foot).norm() < 1e-6;
      };
      EXPECT_EQ(std::count_if(found.begin(), found.end(), same), 1) << "foot " << m.foot.transpose();
    }
    for (size_t m = 0; m < found.size(); ++m) {
      SCOPED_TRACE(testing::Message() << "found " << found[m].point.transpose());
      EXPECT_NE(found[m].status, FootStatus::not_converged);
      EXPECT_LT(found[m].distance, reach);
      EXPECT_NEAR((bound.point(found[m].xi) - d).norm(), found[m].distance, 1e-14);
      const judge::LocalConditions at = bound.conditions(d, found[m].xi);
      EXPECT_GT(at.slope, -1e-10);
      EXPECT_GT(at.curvature, 0.0);
      for (size_t other = 0; other < m; ++other) {
        EXPECT_LE(found[other].distance, found[m].distance);
        EXPECT_GT((found[other].point - found[m].point).norm(), 1e-8);
      }
    }
    if (found.size() > 1) ++several;
  }
  return several;
}

// Refined, so that the minima lie in different elements and degrees are mixed.
Surface refined(Surface surface) {
  while (surface.space.degree(0) < 2) surface = elevate_degree(surface, 0);
  while (surface.space.degree(1) < 3) surface = elevate_degree(surface, 1);
  for (int i = 0; i < 2; ++i) {
    const KnotVector knots = surface.space.knots(i);
    for (const double t : {0.13, 0.37, 0.61, 0.89})
      surface = insert_knot(surface, i, knots.front() + t * (knots.back() - knots.front()));
  }
  return surface;
}

// z = slope |x| on [-1, 1] x [-1, 1], with a C0 line at x = 0.
Surface groove(double slope) {
  Surface groove{Space<2>({KnotVector::uniform(1, 2), KnotVector::uniform(1, 1)}), NodalVectors(3, 6)};
  int a = 0;
  for (const double y : {-1.0, 1.0})
    for (const double x : {-1.0, 0.0, 1.0}) groove.control_points.col(a++) << x, y, slope * std::abs(x);
  return refined(groove);
}

TEST(AllMinima, VGroove) {
  EXPECT_GT(expect_all_minima(groove(1.0), {-0.4, -0.9, 0.45}, {0.4, 0.9, 0.9}, 2.0), 30);
  EXPECT_GT(expect_all_minima(groove(0.3), {-0.1, -0.9, 0.2}, {0.1, 0.9, 0.5}, 0.4), 5);  // some out of reach
}

// Above a ridge its C0 line is the one foot.
TEST(AllMinima, Ridge) {
  EXPECT_EQ(expect_all_minima(groove(-0.5), {-0.1, -0.9, 0.3}, {0.1, 0.9, 0.8}, 2.0), 0);
}

// z = 3 x^2 + y^2 / 2: above the centres of curvature each flank has its foot.
TEST(AllMinima, Trough) {
  Surface trough{Space<2>({KnotVector::uniform(2, 1), KnotVector::uniform(2, 1)}), NodalVectors(3, 9)};
  int a = 0;
  for (const double y : {-1.0, 0.0, 1.0})
    for (const double x : {-1.0, 0.0, 1.0})  // the blossom of x^2 on [-1, 1] is 1, -1, 1
      trough.control_points.col(a++) << x, y,
          3.0 * (2.0 * std::abs(x) - 1.0) + 0.5 * (2.0 * std::abs(y) - 1.0);
  EXPECT_GT(expect_all_minima(refined(trough), {-0.2, -0.3, 0.6}, {0.2, 0.3, 1.6}, 5.0), 20);
  // Close to one flank, far from the other: the near foot is within its local reach, the far one is not. (The
  // small elements give the window a frame that makes its reach nearly the radius of curvature.)
  const KnotVector knots = trough.space.knots(0);
  for (int i = 0; i < 2; ++i)
    for (const double t : {0.4999, 0.5001})
      trough = insert_knot(trough, i, knots.front() + t * (knots.back() - knots.front()));
  EXPECT_GT(expect_all_minima(trough, {0.32, -0.1, 0.6}, {0.36, 0.1, 0.65}, 5.0), 20);
}

// Three quarters of a round and of an oval tube.
TEST(AllMinima, InsideOfATube) {
  Surface tube = refined(shapes::revolve(shapes::line(1.0, 3.0), M_PI / 2, 3));
  EXPECT_EQ(expect_all_minima(tube, {-0.6, 0.1, 0.1}, {-0.1, 0.6, 2.9}, 0.9), 0);
  tube.control_points.row(1) *= 0.5;
  EXPECT_GT(expect_all_minima(tube, {-0.5, -0.1, 0.1}, {0.5, 0.1, 2.9}, 2.0), 30);
}

// A circle of radius `radius` about (centre, 0).
shapes::Profile circle(double centre, double radius) {
  const double s = std::sqrt(0.5);
  shapes::Profile circle{
      KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}), {}, {}, {1, s, 1, s, 1, s, 1, s, 1}};
  for (const double x : {1, 1, 0, -1, -1, -1, 0, 1, 1}) circle.rho.push_back(centre + radius * x);
  for (const double z : {0, 1, 1, 1, 0, -1, -1, -1, 0}) circle.z.push_back(radius * z);
  return circle;
}

TEST(AllMinima, InsideOfATorus) {
  Surface torus = refined(shapes::revolve(circle(3.0, 1.0), M_PI / 2, 2));
  EXPECT_GT(expect_all_minima(torus, {-2.0, 2.0, -0.5}, {2.0, 2.9, 0.5}, 6.0), 10);
  torus.control_points.row(2) *= 0.4;
  EXPECT_GT(expect_all_minima(torus, {-1.5, 2.0, -0.2}, {1.5, 2.5, 0.2}, 2.0), 20);
}

}  // namespace
}  // namespace search
