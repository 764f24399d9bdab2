// SPDX-License-Identifier: GPL-2.0-or-later
// Against all pairs of points.
#include "nurbs/coincident.h"

#include <gtest/gtest.h>

#include <random>

namespace nurbs {
namespace {

// Each point joins the first of those before it that stand for themselves and are near.
std::vector<int> of_all_pairs(const NodalVectors& points, double tolerance) {
  std::vector<int> first(points.cols());
  for (int i = 0; i < points.cols(); ++i) {
    first[i] = i;
    for (int k = i - 1; k >= 0; --k)
      if (first[k] == k && (points.col(i) - points.col(k)).norm() <= tolerance) first[i] = k;
  }
  return first;
}

// Clusters of points up to a few tolerances apart, so that some are near by a hair and some are not.
NodalVectors clusters(int seed, double spread, const Vector3& origin) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  NodalVectors points(3, 600);
  for (int i = 0; i < points.cols(); ++i) {
    points.col(i) = i < 50 ? origin : Vector3(points.col(random() % 50));
    for (double& x : points.col(i)) x += (i < 50 ? 1.0 : spread) * within(random);
  }
  return points;
}

TEST(Coincident, SameAsOfAllPairs) {
  for (int seed = 0; seed < 5; ++seed)
    for (const double spread : {0.0, 0.3, 1.0, 3.0, 30.0})
      for (const double origin : {0.0, 1000.0}) {
        const NodalVectors points = clusters(seed, spread * 1e-6, Vector3::Constant(origin));
        const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
        EXPECT_EQ(first_coincident(points, 1e-6), of_all_pairs(points, 1e-6 * size)) << spread;
      }
}

TEST(Coincident, AllInOnePlaceOrNone) {
  EXPECT_EQ(first_coincident(NodalVectors::Constant(3, 3, 7.0), 1e-6), std::vector<int>({0, 0, 0}));
  EXPECT_TRUE(first_coincident(NodalVectors(3, 0), 1e-6).empty());
}

}  // namespace
}  // namespace nurbs
