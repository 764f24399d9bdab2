// SPDX-License-Identifier: GPL-2.0-or-later
// Closest points with closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "feet.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

constexpr double kQuarter = M_PI / 2;

// A point and its foot; the parameters to 1e-10 (given with 12 digits), the distance too.
struct Expected {
  Vector3 d;
  double xi, eta, distance;
  FootStatus status;
};

void expect_foot(const Surface& surface, const Foot& p, const Expected& expected) {
  EXPECT_NEAR(p.xi[0], expected.xi, 1e-10);
  EXPECT_NEAR(p.xi[1], expected.eta, 1e-10);
  EXPECT_NEAR(p.distance, expected.distance, 1e-10);
  EXPECT_EQ(p.status, expected.status);
  EXPECT_NEAR((interpolate(surface.space, surface.control_points, p.xi) - p.point).norm(), 0.0, 1e-13);
  EXPECT_NEAR((expected.d - p.point).norm(), p.distance, 1e-14);
}

// Cold, and warm from a grid of guesses all over the patch.
void expect_feet(const Surface& surface, const std::vector<Expected>& cases) {
  for (const Expected& expected : cases) {
    SCOPED_TRACE(testing::Message() << "d = " << expected.d.transpose());
    expect_foot(surface, closest(surface, expected.d), expected);
    for (double xi : {0.0, 0.1, 0.5, 0.8, 1.0})
      for (double eta : {0.0, 0.3, 0.9, 1.0}) {
        SCOPED_TRACE(testing::Message() << "from " << xi << ", " << eta);
        expect_foot(surface, closest_from(surface, expected.d, {xi, eta}), expected);
      }
  }
}

using Status = FootStatus;

TEST(ClosestPoint, QuarterCylinder) {
  Surface cylinder = shapes::revolve(shapes::line(10.0, 20.0), kQuarter);
  const std::vector<Expected> cases = {
      {{9, 7, 5}, .424848249847, .25, 1.401754250991, Status::interior},
      {{3, 12, 13.7}, .834349222369, .685, 2.369316876853, Status::interior},
      {{2, 1, 4}, .304113535976, .2, 7.763932022500, Status::interior},
      {{10.9, .05, 19.99}, .003240513453, .9995, .900114678296, Status::interior},
      {{12, -1, 3}, 0.0, .15, 2.236067977500, Status::edge},
      {{5, 9, 21}, .669061273414, 1.0, 1.042783381273, Status::edge},
      {{11, -1, -1}, 0.0, 0.0, std::sqrt(3.0), Status::corner},
  };
  expect_feet(cylinder, cases);
  // The same with degrees 3 x 2 on many elements, which changes the parametrisation of nothing.
  cylinder = elevate_degree(elevate_degree(cylinder, 0), 1);
  for (double knot : {.1, .25, .3, .4, .6, .85})
    cylinder = insert_knot(insert_knot(cylinder, 0, knot), 1, knot, knot == .3 ? 2 : 1);
  expect_feet(cylinder, cases);
}

TEST(ClosestPoint, SphereOctantWithPole) {
  const Surface octant = shapes::revolve(shapes::quarter_arc(0.0, 5.0), kQuarter);
  expect_feet(octant, {
                          {{3, 4, 2}, .585786437627, .252232036080, .385164807135, Status::interior},
                          {{1, 2, 5.5}, .695886464024, .744222253589, .937171043519, Status::interior},
                          {{.3, .4, 5.2}, .585786437627, .933486896879, .223983154644, Status::interior},
                      });
}

TEST(ClosestPoint, QuarterTorus) {
  const Surface torus = shapes::revolve(shapes::quarter_arc(10.0, 3.0), kQuarter);
  expect_feet(torus, {
                         {{9, 9, 2}, .5, .407619741171, .382537327635, Status::interior},
                         {{12, 3, 3}, .165650777631, .570650879220, .822782031838, Status::interior},
                     });
}

// Random points around a full cylinder of four arcs: the foot has the azimuth of the point, whatever the arc
// and the start.  The C0 knots between the arcs are smooth there, so they must not show.
TEST(ClosestPoint, FullCylinderAcrossArcs) {
  const Surface cylinder = shapes::revolve(shapes::line(2.0, 5.0), kQuarter, 4);
  shapes::Random random(1);
  for (int k = 0; k < 400; ++k) {
    const double azimuth = shapes::uniform(random, 0.3, 2 * M_PI - 0.3),
                 z = shapes::uniform(random, 0.0, 5.0);
    const double rho = shapes::uniform(random, 0.5, 4.0);
    const Vector3 d(rho * std::cos(azimuth), rho * std::sin(azimuth), z);
    const int arc = static_cast<int>(azimuth / kQuarter);
    const double xi = arc + shapes::arc_parameter(azimuth - arc * kQuarter, kQuarter);
    const double start = xi + shapes::uniform(random, -0.9, 0.9);
    for (const Foot& p :
         {closest(cylinder, d), closest_from(cylinder, d, {start, shapes::uniform(random, 0.0, 1.0)})}) {
      EXPECT_NEAR(p.distance, std::abs(rho - 2.0), 1e-14);
      EXPECT_NEAR(p.xi[0], xi, 1e-13);
      EXPECT_NEAR(p.xi[1], z / 5.0, 1e-14);
      EXPECT_EQ(p.status, Status::interior);
    }
  }
}

// A foot exactly on the border of two arcs is as interior as any other.
TEST(ClosestPoint, SmoothCreaseIsInterior) {
  const Surface cylinder = shapes::revolve(shapes::line(2.0, 5.0), kQuarter, 4);
  for (double rho : {1.0, 3.0})
    for (double start : {0.7, 1.0, 1.4}) {
      const Foot p = closest_from(cylinder, {0.0, rho, 2.5}, {start, 0.2});
      EXPECT_NEAR(p.xi[0], 1.0, 1e-15);
      EXPECT_EQ(p.status, Status::interior);
    }
}

// On a flat, affinely parametrised patch the foot is the point's shadow to pure round-off of the patch size.
TEST(ClosestPoint, FlatPatchToRoundOff) {
  shapes::Random random(2);
  for (int degree = 1; degree <= 6; ++degree) {
    const KnotVector graded = KnotVector::from_breaks(degree, {0, .1, .15, .4, .75, 1});
    const Surface flat =
        plane({-0.3, -0.3, 0}, {0.6, 0, 0}, {0, 0.6, 0}, {graded, KnotVector::uniform(degree, 31, 2.0, 3.0)});
    for (int k = 0; k < 200; ++k) {
      const Vector3 shadow(shapes::uniform(random, -.3, .3), shapes::uniform(random, -.3, .3), 0.0);
      const Vector3 d = shadow + Vector3(0, 0, shapes::uniform(random, -0.1, 0.1));
      const Foot p = closest_from(flat, d, shapes::random_parameter(random, flat.space));
      EXPECT_LE((p.point - shadow).lpNorm<Eigen::Infinity>(), 8e-16 * 0.6) << "degree " << degree;
      EXPECT_DOUBLE_EQ(p.distance, std::abs(d.z()));
      EXPECT_EQ(p.status, Status::interior);
    }
  }
}

// A roof of two flats with a ridge (a C0 knot), a concave valley when seen from the other side.
class Roof : public testing::Test {
 protected:
  Surface roof_{Space<2>({KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 2}), KnotVector::uniform(1, 1)}), {}};
  void SetUp() override {
    roof_.control_points.resize(3, 10);
    roof_.control_points << -2, -1, 0, 1, 2, -2, -1, 0, 1, 2,  //
        0, 0, 0, 0, 0, 1, 1, 1, 1, 1,                          //
        0, 1, 2, 1, 0, 0, 1, 2, 1, 0;
  }
};

TEST_F(Roof, RidgeIsAMinimumFromOutside) {
  for (double start : {0.0, 0.3, 0.99, 1.0, 1.2, 2.0}) {
    const Foot p = closest_from(roof_, {0.3, 0.4, 3.0}, {start, 0.9});
    EXPECT_EQ(p.xi[0], 1.0);
    EXPECT_NEAR(p.xi[1], 0.4, 1e-15);
    EXPECT_NEAR(p.distance, std::hypot(0.3, 1.0), 1e-15);
    EXPECT_EQ(p.status, Status::edge);
  }
}

TEST_F(Roof, SlopesAreFoundAcrossTheRidge) {
  for (double start : {0.0, 0.3, 0.99, 1.0, 1.2, 2.0})
    for (double side : {-1.0, 1.0}) {
      const Foot p =
          closest_from(roof_, {side * 2.0, 0.4, 2.0}, {start, 0.1});  // above the middle of a slope
      EXPECT_NEAR((p.point - Vector3(side, 0.4, 1.0)).norm(), 0.0, 1e-15);
      EXPECT_EQ(p.status, Status::interior);
    }
}

TEST_F(Roof, ValleyHasAMinimumOnEachSide) {
  for (double start : {0.2, 0.9, 1.1, 1.8}) {
    const Foot p = closest_from(roof_, {0.0, 0.4, 1.5}, {start, 0.1});
    EXPECT_NEAR(p.distance, 0.5 / std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(p.point.x(), start < 1.0 ? -0.25 : 0.25, 1e-15);
    EXPECT_EQ(p.status, Status::interior);
  }
}

// From beyond the axis, the middle of a concave arc is the farthest point: stationary, but no minimum.
TEST(ClosestPoint, LeavesAMaximum) {
  const Surface cylinder = shapes::revolve(shapes::line(10.0, 20.0), kQuarter);
  const Foot p = closest_from(cylinder, {-5, -5, 8}, {0.5, 0.4});
  EXPECT_NEAR(p.distance, std::hypot(15.0, 5.0), 1e-13);
  EXPECT_EQ(p.status, Status::edge);
}

TEST(ClosestPoint, LeavesASaddle) {
  // A point above the saddle z = x^2 - y^2 beyond its radius of curvature 1/2: feet at x = 0, or at y = 0,
  // +-x.
  Surface saddle{Space<2>({KnotVector::uniform(2, 1, -1, 1), KnotVector::uniform(2, 1, -1, 1)}), {}};
  saddle.control_points.resize(3, 9);
  int a = 0;
  for (int j : {-1, 0, 1})
    for (int i : {-1, 0, 1}) {
      // Blossom of t^2 at two ends of [-1, 1]: 1, -1, 1.
      saddle.control_points.col(a++) << i, j, (i == 0 ? -1.0 : 1.0) - (j == 0 ? -1.0 : 1.0);
    }
  const double height = 0.8;
  const Foot p = closest_from(saddle, {0, 0, height}, {0.0, 0.0});
  // Minimum of x^2 + (x^2 - h)^2: x^2 = h - 1/2.
  EXPECT_NEAR(std::abs(p.point.x()), std::sqrt(height - 0.5), 1e-14);
  EXPECT_NEAR(p.point.y(), 0.0, 1e-14);
  EXPECT_NEAR(p.distance, std::sqrt(height - 0.25), 1e-14);
}

// A ball rolled in a full bowl straight through the pole, and past it at any distance, warm-started.
TEST(ClosestPoint, RollsThroughAPole) {
  const Surface bowl = shapes::revolve(shapes::quarter_arc(0.0, 5.0), kQuarter, 4);
  for (double offset : {0.0, 1e-14, 1e-9, 1e-4, 0.1})
    for (double direction : {0.2, 1.0, M_PI / 2 + 1.0}) {
      Parameter<2> xi = closest(bowl, {-std::cos(direction), -std::sin(direction), 4.0}).xi;
      for (int step = -20; step <= 20; ++step) {
        const double along = step * 0.05;
        const Vector3 d(along * std::cos(direction) - offset * std::sin(direction),
                        along * std::sin(direction) + offset * std::cos(direction), 4.0);
        const Foot p = closest_from(bowl, d, xi);
        EXPECT_NEAR(p.distance, 5.0 - d.norm(), 1e-13) << offset << " " << direction << " " << step;
        EXPECT_NE(p.status, Status::not_converged);
        xi = p.xi;
      }
    }
}

// Every point of a cylinder or sphere is as near to its axis or centre: any foot is right, none may hang.
TEST(ClosestPoint, FocalPoints) {
  const Surface cylinder = shapes::revolve(shapes::line(10.0, 20.0), kQuarter);
  const Surface octant = shapes::revolve(shapes::quarter_arc(0.0, 5.0), kQuarter);
  for (double guess : {0.0, 0.3, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(closest_from(cylinder, {0, 0, 7}, {guess, 0.1}).distance, 10.0, 1e-13);
    const Foot p = closest_from(octant, {0, 0, 0}, {guess, guess});
    EXPECT_NEAR(p.distance, 5.0, 1e-13);
    EXPECT_NE(p.status, Status::not_converged);
  }
}

// A long facet (0,0)-(10,0) and one that folds back over it.  The nearest sample of the first is their common
// edge, from where the way down leads along the second; the foot on the first is nearer all the same.
TEST(ClosestPoint, EveryElementIsSearchedForItself) {
  Surface fold{Space<2>({KnotVector(1, {0, 0, 1, 2, 2}), KnotVector::uniform(1, 1)}), {}};
  fold.control_points.resize(3, 6);
  fold.control_points << 0, 10, 9, 0, 10, 9,  //
      0, 0, 0, 1, 1, 1,                       //
      0, 0, 4, 0, 0, 4;
  const int elements[] = {1, 0};
  const SurfaceProjector projector(fold.space, fold.control_points);
  const Foot p = projector.cold_on({8, 0.4, 1.5}, elements, 2);
  EXPECT_NEAR(p.distance, 1.5, 1e-15);
  EXPECT_NEAR(p.xi[0], 0.8, 1e-15);
}

TEST(ClosestPoint, ScalingAllLengthsChangesNothing) {
  shapes::Random random(3);
  const Surface hills = shapes::random_hills(
      random, {KnotVector::uniform(2, 6), KnotVector::from_breaks(3, {0, .2, .3, 1})}, 0.3, true);
  for (const double scale : {1.0 / 1024, 1e-3, 1e3}) {
    const Surface scaled{hills.space, scale * hills.control_points};
    for (int k = 0; k < 200; ++k) {
      const Vector3 d(shapes::uniform(random, -.2, 1.2), shapes::uniform(random, -.2, 1.2), .4);
      const Foot p = closest(hills, d), q = closest(scaled, scale * d);
      EXPECT_EQ(p.status, q.status);
      EXPECT_NEAR(q.distance, scale * p.distance, 1e-14 * scale);
      EXPECT_NEAR((q.point - scale * p.point).norm(), 0.0, 1e-12 * scale);
      if (scale == 1.0 / 1024) {
        EXPECT_EQ(p.xi, q.xi);  // a power of two: the same bits
        EXPECT_EQ(p.iterations, q.iterations);
      }
    }
  }
}

TEST(ClosestPoint, NotANumberIsNotConverged) {
  const Surface flat =
      plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {KnotVector::uniform(2, 4), KnotVector::uniform(2, 4)});
  EXPECT_EQ(closest_from(flat, {NAN, 0.5, 0.5}, {0.5, 0.5}).status, Status::not_converged);
  EXPECT_EQ(closest_from(flat, {0.2, 0.5, 0.5}, {NAN, 0.5}).status, Status::not_converged);
}

}  // namespace
}  // namespace search
