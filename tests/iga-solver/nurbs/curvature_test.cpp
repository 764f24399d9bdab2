// SPDX-License-Identifier: GPL-2.0-or-later
// Principal curvatures against closed forms that know nothing of the parameters.
#include "nurbs/curvature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "nurbs/shapes.h"

namespace nurbs {
namespace {

using shapes::Random;
using shapes::uniform;

// z = (a x^2 + 2 b x y + c y^2) / 2 over the parallelogram x = u + shear v, y = length v, u and v in [0, 1].
struct Graph {
  double a, b, c, shear, length;

  // One biquadratic element: a control point is the polar form at (0,0), (0,1) or (1,1) in u and in v.
  Surface patch() const {
    const KnotVector knots = KnotVector::uniform(2, 1, 0.0, 1.0);
    Surface surface{Space<2>({knots, knots}), NodalVectors(3, 9)};
    const double uu = a, uv = a * shear + b * length,
                 vv = a * shear * shear + 2.0 * b * shear * length + c * length * length;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const double u = 0.5 * i, v = 0.5 * j;
        const double u2 = i == 2 ? 1.0 : 0.0, v2 = j == 2 ? 1.0 : 0.0;
        const double z = 0.5 * (uu * u2 + 2.0 * uv * u * v + vv * v2);
        surface.control_points.col(i + 3 * j) << u + shear * v, length * v, z;
      }
    return surface;
  }

  // Of a graph (do Carmo 1976, section 3-3, example 5), normal upwards.
  void curvatures(double x, double y, double (&out)[2]) const {
    const double p = a * x + b * y, q = b * x + c * y, g = 1.0 + p * p + q * q;
    const double gauss = (a * c - b * b) / (g * g);
    const double mean = ((1.0 + p * p) * c - 2.0 * p * q * b + (1.0 + q * q) * a) / (2.0 * g * std::sqrt(g));
    const double root = std::sqrt(mean * mean - gauss);
    out[0] = mean - root, out[1] = mean + root;
  }
};

TEST(Curvature, GraphOverShearedParameters) {
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Graph graph{uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2),
                      uniform(random, -3, 3), uniform(random, 0.3, 5)};
    const PatchedSurface surface = join({insert_knots(graph.patch(), 0, {0.3, 0.7})});
    for (int sample = 0; sample < 20; ++sample) {
      const SurfacePoint at{0, shapes::random_parameter(random, surface.topology.patch(0))};
      const SurfaceShape shape = shape_at(surface.topology, surface.control_points, at);
      double expected[2];
      graph.curvatures(shape.point.x(), shape.point.y(), expected);
      const double size = std::abs(expected[0]) + std::abs(expected[1]);
      EXPECT_NEAR(shape.curvature[0], expected[0], 1e-10 * size);
      EXPECT_NEAR(shape.curvature[1], expected[1], 1e-10 * size);
      EXPECT_GT(shape.normal.z(), 0.0);
      EXPECT_NEAR(shape.normal.norm(), 1.0, 1e-12);
    }
  }
}

// 1/tube and cos(angle) / (distance from the axis), bent away from the outward normal.
TEST(Curvature, Torus) {
  const double radius = 3.0, tube = 1.25;
  const PatchedSurface ring =
      join({torus(frame({1, 2, 3}, {0, 0, 1}), radius, tube, refined(arc(0, 360), 8, 3), arc(0, 360))});
  Random random(8);
  for (int sample = 0; sample < 200; ++sample) {
    const SurfacePoint at{0, shapes::random_parameter(random, ring.topology.patch(0))};
    const SurfaceShape shape = shape_at(ring.topology, ring.control_points, at);
    const double from_axis = std::hypot(shape.point.x() - 1.0, shape.point.y() - 2.0);
    const double around = -(from_axis - radius) / tube / from_axis, across = -1.0 / tube;
    EXPECT_NEAR(shape.curvature[0], std::min(around, across), 1e-11);
    EXPECT_NEAR(shape.curvature[1], std::max(around, across), 1e-11);
  }
}

TEST(Curvature, OfAPoleIsUnbounded) {
  const PatchedSurface ball = join({sphere(frame({0, 0, 0}, {0, 0, 1}), 2.0, arc(0, 360), arc(-90, 90))});
  const KnotVector& latitude = ball.topology.patch(0).knots(1);
  for (const double eta : {latitude.front(), latitude.back()}) {
    const SurfaceShape shape = shape_at(ball.topology, ball.control_points, {0, {0.4, eta}});
    EXPECT_EQ(shape.curvature[0], -INFINITY);
    EXPECT_EQ(shape.curvature[1], INFINITY);
  }
}

}  // namespace
}  // namespace nurbs
