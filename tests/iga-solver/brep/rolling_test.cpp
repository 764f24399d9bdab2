// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and energy of a ball that is pressed on a wall and moved over its edges and vertices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "brep/builder.h"
#include "roller.h"
#include "trial_walls.h"

namespace brep {
namespace {

// A jump of the force by F in one of `steps` steps of a way L would be a slope of F * steps / L.
TEST(Rolling, OverEdgesOfAnyAngleForceIsContinuousAndEnergyKept) {
  for (const double turned : {0.5, 2.0, 5.0, 30.0, 90.0})
    for (const double sign : {-1.0, 1.0}) {
      // Over the edge of two plates, pressed by 5 % of the radius, on the convex and the concave side.
      const double bend = turned * nurbs::kPi / 180.0, radius = 0.1;
      const Surface wall = trials::built(trials::plates({0.0, nurbs::kPi - sign * bend}));
      trials::Roller roller(wall, radius);
      const Vector3 middle(0.0, 0.95 * radius, 0.5);
      const double end = turned == 90.0 && sign > 0.0 ? 0.05 : -0.05;  // not through the other plate
      const auto way = roller.along(middle + Vector3(0.15, 0.0, 0.0), middle + Vector3(end, 0.0, 0.1), 6000);
      const bool smooth = bend < 0.02;
      const bool convex = sign < 0.0;
      if (!smooth || convex) {
        EXPECT_LT(way.slope, 20.0) << turned << (convex ? " convex" : " concave");
        EXPECT_LT(way.energy_lost, 1e-7) << turned;
      } else {
        EXPECT_LT(way.slope * 0.22 / 6000.0, 1.5 * bend * 0.05 * radius)
            << "a jump by the edge's angle at most";
      }
      EXPECT_GE(way.least, bend < 0.1 ? 1 : 0);
      EXPECT_EQ(way.most, convex || smooth ? 1 : 2) << turned;
    }
}

TEST(Rolling, OverEdgesAndVerticesOfACubeAndInsideAnOpenBox) {
  std::mt19937 random(5);
  for (const bool inside : {false, true}) {
    const Surface wall = trials::built(inside ? trials::open_box() : trials::cube());
    trials::Roller roller(wall, 0.2);
    for (int k = 0; k < 60; ++k) {
      // Round a corner, never through the wall.
      const auto beside = [&]() -> Vector3 {
        std::uniform_real_distribution<double> share(0.0, 1.0);
        const Vector3 x(share(random), share(random), share(random));
        return inside ? Vector3(0.1 + 0.2 * x[0], 0.1 + 0.2 * x[1], 0.1 + 0.2 * x[2])
                      : Vector3(1.05 + 0.15 * x[0], 0.85 + 0.3 * x[1], 0.85 + 0.3 * x[2]);
      };
      const auto way = roller.along(beside(), beside(), 500);
      EXPECT_LT(way.slope, 10.0);
      EXPECT_LT(way.energy_lost, 1e-6);
      EXPECT_LE(way.most, inside ? 3 : 1);
    }
  }
}

}  // namespace
}  // namespace brep
