// SPDX-License-Identifier: GPL-2.0-or-later
// Distances from single triangles, in their plane and in space.
#include "brep/plane_triangles.h"

#include <gtest/gtest.h>

#include <random>

#include "brep/builder.h"
#include "brep/piece_distance.h"

namespace brep {
namespace {

// Over all parts of each: inside, sides and corners.
TEST(PlaneTriangles, DistancesAreThoseInSpace) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  for (int k = 0; k < 200; ++k) {
    nurbs::NodalVectors corners(3, 3);
    for (int i = 0; i < 3; ++i) corners.col(i) = vector();
    const Surface surface = from_triangles(corners, {0, 1, 2});
    const PlaneTriangle triangle = plane_triangles(surface)[0];
    ASSERT_TRUE(triangle.exists());
    for (int n = 0; n < 100; ++n) {
      const Vector3 d = 2.0 * vector();
      const double distance = distance_of_piece(surface, 0, d);
      EXPECT_LE(triangle.least_distance(d), distance) << corners << " from " << d.transpose();
      EXPECT_GE(triangle.least_distance(d), distance - 3.0 * surface.slack)
          << corners << " from " << d.transpose();
    }
    const Vector3 inside = corners.rowwise().mean();
    EXPECT_EQ(triangle.least_distance(inside), 0.0);
  }
}

}  // namespace
}  // namespace brep
