// SPDX-License-Identifier: GPL-2.0-or-later
// Closest points on round shapes, in closed form (the first three sets of feet are reference cases D1 to D3).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "feet.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

Curve meshed_arc(double from, double to, int elements, int degree = 2) {
  return refined(arc(from, to), elements, degree);
}

// A frame in general position, not far from the origin.
Frame tilted() { return frame({0.3, -0.2, 0.5}, {1, 2, 3}, {1, -1, 4}); }
Frame upright() { return frame({0, 0, 0}, {0, 0, 1}); }

struct ExpectedFoot {
  Vector3 d;
  double xi, eta, distance;
};

// The feet in the shape's own frame, and the same wherever the shape stands: parameters and distance to
// 1e-10.
void expect_feet(const std::function<Surface(const Frame&)>& shape, const std::vector<ExpectedFoot>& feet) {
  for (const Frame& f : {upright(), tilted()}) {
    const Surface surface = shape(f);
    for (const ExpectedFoot& foot : feet) {
      SCOPED_TRACE(testing::Message() << "d = " << foot.d.transpose());
      const Foot p = closest(surface, f.origin + f.axes * foot.d);
      EXPECT_NEAR(p.xi[0], foot.xi, 1e-10);
      EXPECT_NEAR(p.xi[1], foot.eta, 1e-10);
      EXPECT_NEAR(p.distance, foot.distance, 1e-10);
      EXPECT_NE(p.status, FootStatus::not_converged);
    }
  }
}

TEST(Primitives, FeetOnAQuarterCylinder) {
  for (const int degree : {2, 3})
    expect_feet(
        [&](const Frame& f) {
          return cylinder(f, 10, 20, meshed_arc(0, 90, 5, degree), KnotVector::uniform(degree, 7));
        },
        {{{9, 7, 5}, .424848249847, .25, 1.401754250991},
         {{3, 12, 13.7}, .834349222369, .685, 2.369316876853},
         {{2, 1, 4}, .304113535976, .2, 7.763932022500},
         {{10.9, .05, 19.99}, .003240513453, .9995, .900114678296},
         {{12, -1, 3}, 0.0, .15, 2.236067977500},
         {{5, 9, 21}, .669061273414, 1.0, 1.042783381273}});
}

TEST(Primitives, FeetOnASphereOctant) {
  for (const int degree : {2, 3})
    expect_feet(
        [&](const Frame& f) {
          return sphere(f, 5, meshed_arc(0, 90, 4, degree), meshed_arc(0, 90, 5, degree));
        },
        {{{3, 4, 2}, .585786437627, .252232036080, .385164807135},
         {{1, 2, 5.5}, .695886464024, .744222253589, .937171043519},
         {{.3, .4, 5.2}, .585786437627, .933486896879, .223983154644}});
}

TEST(Primitives, FeetOnAQuarterTorus) {
  for (const int degree : {2, 3})
    expect_feet(
        [&](const Frame& f) {
          return torus(f, 10, 3, meshed_arc(0, 90, 3, degree), meshed_arc(0, 90, 4, degree));
        },
        {{{9, 9, 2}, .5, .407619741171, .382537327635},
         {{12, 3, 3}, .165650777631, .570650879220, .822782031838}});
}

// Whole shapes, from inside and outside, near seams and poles: the distance is the signed one's size.
TEST(Primitives, DistancesFromWholeShapes) {
  shapes::Random random(5);
  const Surface ball = sphere(upright(), 1.0, meshed_arc(0, 360, 8), meshed_arc(-90, 90, 4));
  const Surface ring = torus(upright(), 1.0, 0.4, meshed_arc(0, 360, 8), meshed_arc(0, 360, 8));
  const auto near = [&] { return std::pow(10.0, shapes::uniform(random, -12, 0)); };
  for (int k = 0; k < 200; ++k) {
    const double azimuth = (k % 2 ? 1 : -1) * near();
    const double latitude = (k % 4 < 2 ? 1 : -1) * (M_PI / 2 - near());
    const double scale = shapes::uniform(random, 0.3, 2.0);
    const Vector3 towards(std::cos(azimuth) * std::cos(latitude), std::sin(azimuth) * std::cos(latitude),
                          std::sin(latitude));
    EXPECT_NEAR(closest(ball, scale * towards).distance, std::abs(scale - 1.0), 1e-13);

    const double around = (k % 4 < 2 ? 1 : -1) * near(), r = shapes::uniform(random, 0.1, 0.8);
    const double rho = 1 + r * std::cos(around);
    const Vector3 d(rho * std::cos(azimuth), rho * std::sin(azimuth), r * std::sin(around));
    EXPECT_NEAR(closest(ring, d).distance, std::abs(r - 0.4), 1e-13);
  }
}

}  // namespace
}  // namespace search
