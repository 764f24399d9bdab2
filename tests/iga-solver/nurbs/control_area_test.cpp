// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/control_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nurbs/primitives.h"

namespace nurbs {
namespace {

const Frame kTilted = frame(Vector3(1.0, 2.0, 3.0), Vector3(0.3, -0.2, 1.0));

double area(const Surface& surface) {
  return control_point_areas(surface.space, surface.control_points).sum();
}

TEST(ControlPointAreas, OfAParallelogramAreIntegralsOfBSplines) {
  const std::array<KnotVector, 2> knots{KnotVector(2, {0, 0, 0, 0.2, 0.2, 0.7, 1, 1, 1}),
                                        KnotVector::uniform(3, 4)};
  const Surface surface = plane({5, 0, 0}, {2, 0, 0}, {1, 3, 0}, knots);
  const Eigen::VectorXd areas = control_point_areas(surface.space, surface.control_points);
  for (int a = 0; a < areas.size(); ++a) {
    double expected = 6.0;  // integral of N_i = (knot[i+p+1] - knot[i]) / (p+1)  (de Boor 1978, chapter X)
    const int index[2] = {a % knots[0].control_point_count(), a / knots[0].control_point_count()};
    for (int d = 0; d < 2; ++d) {
      const int p = knots[d].degree(), i = index[d];
      expected *= (knots[d].knots()[i + p + 1] - knots[d].knots()[i]) / (p + 1);
    }
    EXPECT_NEAR(areas[a], expected, 1e-14);
  }
}

TEST(ControlPointAreas, SumToTheAreaOfRoundSurfaces) {
  const Curve turn = refined(arc(0, 360), 16, 2), half = refined(arc(-90, 90), 8, 2);
  EXPECT_NEAR(area(cylinder(kTilted, 2.0, 3.0, turn, KnotVector::uniform(1, 2))), 12 * kPi, 1e-9);
  EXPECT_NEAR(area(sphere(kTilted, 2.0, turn, half)), 16 * kPi, 1e-7);
  EXPECT_NEAR(area(torus(kTilted, 3.0, 1.0, turn, turn)), 12 * kPi * kPi, 1e-7);
}

TEST(ControlPointAreas, OfASphereConvergeFast) {
  const auto error = [](int elements) {
    return std::abs(area(sphere(kTilted, 1.0, refined(arc(0, 360), elements, 2),
                                refined(arc(-90, 90), elements / 2, 2))) -
                    4 * kPi);
  };
  EXPECT_GT(error(4) / error(8), 64.0);
}

}  // namespace
}  // namespace nurbs
