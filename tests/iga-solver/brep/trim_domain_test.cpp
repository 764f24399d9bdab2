// SPDX-License-Identifier: GPL-2.0-or-later
// What is inside of a face's loops, against the winding number of a fine polygon.
#include "brep/trim_domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace brep {
namespace {

using Point = Eigen::Vector2d;

// A closed rational curve of degree 2 or 3, wound about a centre.
Trim wavy(const Point& centre, double size, int lobes, int degree, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.7, 1.3);
  const int count = degree * lobes + 1;
  Trim trim{};
  trim.curve.degree = degree;
  trim.curve.points.resize(2, count);
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * M_PI * k / (count - 1), radius = size * uniform(random);
    trim.curve.points.col(k) = centre + radius * Point(std::cos(angle), std::sin(angle));
    trim.curve.weights.push_back(uniform(random));
  }
  trim.curve.points.col(count - 1) = trim.curve.points.col(0);
  trim.curve.weights.back() = trim.curve.weights.front();
  for (int k = 0; k <= lobes; ++k)
    for (int m = 0; m < (k == 0 || k == lobes ? degree + 1 : degree); ++m) trim.curve.knots.push_back(k);
  return trim;
}

struct Polygon {
  std::vector<Point> points;
  double winding(const Point& x) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point a = points[k] - x, b = points[(k + 1) % points.size()] - x;
      sum += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
    }
    return sum / (2.0 * M_PI);
  }
  double distance(const Point& x) const {
    double least = 1e300;
    for (const Point& p : points) least = std::min(least, (p - x).norm());
    return least;
  }
};

TEST(TrimDomain, HoldsWhatLoopsWindAround) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const int degree = 2 + trial % 2;
    std::vector<Loop> loops{{wavy({0.3, -0.1}, 1.0, 7, degree, random)},
                            {wavy({0.2, 0.0}, 0.3, 4, degree, random)}};
    const TrimDomain domain(loops);
    std::vector<Polygon> polygons;
    double step = 0.0;
    for (const Loop& loop : loops) {
      Polygon& polygon = polygons.emplace_back();
      for (const BezierCurve<2>& curve : beziers(loop[0].curve))
        for (int k = 0; k < 200; ++k) polygon.points.push_back(curve.at(k / 200.0));
      for (std::size_t k = 1; k < polygon.points.size(); ++k)
        step = std::max(step, (polygon.points[k] - polygon.points[k - 1]).norm());
    }
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    int inside = 0, near = 0;
    for (int k = 0; k < 600; ++k) {
      Point x(uniform(random), uniform(random));
      if (k % 2 == 0) {  // beside the border, in the bulge of its parts
        const Polygon& of = polygons[random() % polygons.size()];
        x = of.points[random() % of.points.size()] + 0.01 * x;
      }
      double winding = 0.0, distance = 1e300;
      for (const Polygon& polygon : polygons) {
        winding += polygon.winding(x);
        distance = std::min(distance, polygon.distance(x));
      }
      if (distance < step) continue;
      const bool odd = std::lround(winding) % 2 != 0;
      EXPECT_EQ(domain.inside({x[0], x[1]}), odd) << trial << " at " << x.transpose();
      inside += static_cast<int>(odd);
      near += static_cast<int>(distance < 0.02);
    }
    EXPECT_GT(inside, 50);
    EXPECT_GT(near, 50);
  }
}

}  // namespace
}  // namespace brep
