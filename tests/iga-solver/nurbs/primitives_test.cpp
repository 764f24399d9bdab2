// SPDX-License-Identifier: GPL-2.0-or-later
// Round shapes against their implicit equations and closed-form areas and volumes; their feet are in
// primitives_feet_test.cpp.
#include "nurbs/primitives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

#include "nurbs/boundary.h"
#include "nurbs/shapes.h"

namespace nurbs {
namespace {

constexpr double kDegrees = M_PI / 180;

Curve meshed_arc(double from, double to, int elements, int degree = 2) {
  return refined(arc(from, to), elements, degree);
}

// A frame in general position, not far from the origin.
Frame tilted() { return frame({0.3, -0.2, 0.5}, {1, 2, 3}, {1, -1, 4}); }
Frame upright() { return frame({0, 0, 0}, {0, 0, 1}); }

template <int Dim>
void expect_everywhere(const Patch<Dim>& patch, const std::function<double(const Vector3&)>& error) {
  shapes::Random random(1);
  for (int k = 0; k < 500; ++k) {
    const Parameter<Dim> xi = shapes::random_parameter(random, patch.space);
    EXPECT_LE(std::abs(error(interpolate(patch.space, patch.control_points, xi))), 1e-14);
  }
}

// Arcs, frames.

TEST(Primitives, ArcsLieOnTheUnitCircle) {
  shapes::Random random(2);
  for (int degree = 2; degree <= kMaxDegree; ++degree)
    for (int k = 0; k < 20; ++k) {
      const double from = shapes::uniform(random, -400, 400), to = from + shapes::uniform(random, 1, 360);
      const Curve quarters = arc(from, to);
      const int arcs = quarters.space.element_count();
      EXPECT_LE((to - from) / arcs, 90.0);
      EXPECT_GT((to - from) / std::max(arcs - 1, 1), arcs == 1 ? 0.0 : 90.0);
      const Curve curve = refined(quarters, arcs * (1 + k % 4), degree);
      EXPECT_EQ(curve.space.degree(0), degree);
      EXPECT_EQ(curve.space.element_count(), arcs * (1 + k % 4));
      expect_everywhere(curve, [](const Vector3& x) { return std::hypot(x.norm() - 1.0, x.z()); });
      for (const auto& [xi, angle] : {std::pair(0.0, from), std::pair(1.0, to)}) {
        const Vector3 end = interpolate(curve.space, curve.control_points, {xi});
        EXPECT_NEAR(end.x(), std::cos(angle * kDegrees), 1e-14);
        EXPECT_NEAR(end.y(), std::sin(angle * kDegrees), 1e-14);
      }
    }
}

// The middle of every element of equal arcs: the angle by the tangent rule of a rational quadratic arc.
TEST(Primitives, ArcParameter) {
  const Curve curve = meshed_arc(30, 390, 12, 3);
  const std::vector<double>& breaks = curve.space.knots(0).breaks();
  for (int e = 0; e <= 12; ++e) EXPECT_NEAR(breaks[e], e / 12.0, 1e-16);
  for (int e = 0; e < 12; ++e) {
    const Vector3 x = interpolate(curve.space, curve.control_points, {(e + 0.5) / 12});
    const double within = (e % 3 + 0.5) / 3;  // of its arc
    const double angle =
        30 + 90 * (e / 3) + 45 + 2 / kDegrees * std::atan((2 * within - 1) * std::tan(22.5 * kDegrees));
    EXPECT_NEAR(x.x(), std::cos(angle * kDegrees), 1e-14);
    EXPECT_NEAR(x.y(), std::sin(angle * kDegrees), 1e-14);
  }
}

TEST(Primitives, RightAnglesAreExact) {
  const Curve circle = arc(-90, 270);
  const std::vector<Vector3> joints = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(circle.control_points.col(2 * i), joints[i]);
  EXPECT_EQ(circle.space.knots(0).knots(),
            (std::vector<double>{0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1}));
  ASSERT_GT(128.3 - 38.3, 90.0) << "a right angle, but for the round-off of the difference";
  EXPECT_EQ(arc(38.3, 128.3).space.element_count(), 1);
}

TEST(Primitives, FrameIsOrthonormal) {
  const Frame f = tilted();
  EXPECT_NEAR((f.axes.transpose() * f.axes - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-15);
  EXPECT_NEAR(f.axes.determinant(), 1.0, 1e-15);
  EXPECT_NEAR(f.axes.col(2).cross(Vector3(1, 2, 3)).norm(), 0.0, 1e-15);
  const Vector3 reference(1, -1, 4);
  EXPECT_NEAR(f.axes.col(1).dot(reference), 0.0, 1e-15);
  EXPECT_GT(f.axes.col(0).dot(reference), 0.0);
  // Without a reference: cyclic order, whatever the length of the axis.
  for (int d = 0; d < 3; ++d) {
    const Frame plain = frame({0, 0, 0}, 1e-200 * Vector3::Unit(d));
    EXPECT_EQ(plain.axes.col(2), Vector3(Vector3::Unit(d)));
    EXPECT_EQ(plain.axes.col(0), Vector3(Vector3::Unit((d + 1) % 3)));
  }
}

// Surfaces and their sizes.

// A surface, the signed distance of a point from the exact one (positive outside), and the exact area.
struct Round {
  const char* name;
  Surface surface;
  std::function<double(const Vector3&)> signed_distance;
  double area;
};

std::vector<Round> round_surfaces() {
  const Frame f = tilted();
  const Vector3 o = f.origin, z = Vector3(1, 2, 3).normalized();
  const auto height = [=](const Vector3& x) { return (x - o).dot(z); };
  const auto rho = [=](const Vector3& x) { return (x - o).cross(z).norm(); };
  const double slope = std::atan2(0.7 - 0.2, 1.5), slant = std::hypot(0.5, 1.5);
  const auto from_cone = [=](const Vector3& x) {
    return (rho(x) - 0.7) * std::cos(slope) + height(x) * std::sin(slope);
  };
  const auto from_tip = [=](const Vector3& x) { return (rho(x) - height(x)) * std::sqrt(0.5); };
  const auto from_sphere = [=](const Vector3& x) { return (x - o).norm() - 1.3; };
  const auto from_torus = [=](const Vector3& x) { return std::hypot(rho(x) - 1.0, height(x)) - 0.4; };
  const KnotVector along = KnotVector::uniform(3, 4);
  const double south = std::sin(-40 * kDegrees), north = std::sin(75 * kDegrees);
  return {
      {"cylinder", cylinder(f, 0.7, 1.5, meshed_arc(0, 360, 32), along),
       [=](const Vector3& x) { return rho(x) - 0.7; }, 2 * M_PI * 0.7 * 1.5},
      {"cylinder sector", cylinder(f, 0.7, 1.5, meshed_arc(-20, 130, 24, 4), along),
       [=](const Vector3& x) { return rho(x) - 0.7; }, 150 * kDegrees * 0.7 * 1.5},
      {"frustum", cone(f, {0.7, 0.2}, 1.5, meshed_arc(0, 360, 32, 3), along), from_cone,
       M_PI * (0.7 + 0.2) * slant},
      {"cone with a tip", cone(f, {0, 1}, 1, meshed_arc(10, 100, 8), along), from_tip,
       M_PI / 4 * std::sqrt(2)},
      {"sphere", sphere(f, 1.3, meshed_arc(0, 360, 32), meshed_arc(-90, 90, 16)), from_sphere,
       4 * M_PI * 1.3 * 1.3},
      {"sphere sector", sphere(f, 1.3, meshed_arc(15, 200, 24, 3), meshed_arc(-40, 75, 16, 4)), from_sphere,
       185 * kDegrees * 1.3 * 1.3 * (north - south)},
      {"torus", torus(f, 1.0, 0.4, meshed_arc(0, 360, 32), meshed_arc(0, 360, 32)), from_torus,
       4 * M_PI * M_PI * 0.4},
      {"torus sector", torus(f, 1.0, 0.4, meshed_arc(0, 45, 8, 3), meshed_arc(90, 180, 8)), from_torus,
       M_PI / 4 * (1.0 * 0.4 * M_PI / 2 - 0.4 * 0.4)},
  };
}

Vector3 normal_at(const Surface& surface, const Parameter<2>& xi) {
  RationalBasis<2> basis;
  evaluate(surface.space, xi, 1, basis);
  Vector3 a = Vector3::Zero(), b = Vector3::Zero();
  for (int k = 0; k < basis.count; ++k) {
    a += basis.dR[0][k] * surface.control_points.col(basis.control_point[k]);
    b += basis.dR[1][k] * surface.control_points.col(basis.control_point[k]);
  }
  return a.cross(b);
}

double jacobian_at(const Volume& volume, const Parameter<3>& xi) {
  RationalBasis<3> basis;
  evaluate(volume.space, xi, 1, basis);
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (int k = 0; k < basis.count; ++k)
    for (int d = 0; d < 3; ++d)
      J.col(d) += basis.dR[d][k] * volume.control_points.col(basis.control_point[k]);
  return J.determinant();
}

// Five-point Gauss-Legendre rule on [-1, 1] in closed form (Davis & Rabinowitz 1984), on every element.
template <int Dim>
double integral(const Space<Dim>& space, const std::function<double(const Parameter<Dim>&)>& f) {
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3,
               outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double w_inner = (322 + 13 * std::sqrt(70.0)) / 900, w_outer = (322 - 13 * std::sqrt(70.0)) / 900;
  const double t[] = {-outer, -inner, 0, inner, outer};
  const double weight[] = {w_outer, w_inner, 128.0 / 225, w_inner, w_outer};
  double sum = 0.0;
  for (int e = 0; e < space.element_count(); ++e) {
    const Indices<Dim> element = space.element_indices(e);
    for (int point = 0; point < power(5, Dim); ++point) {
      Parameter<Dim> xi;
      double w = 1.0;
      for (int d = 0, rest = point; d < Dim; ++d, rest /= 5) {
        const double a = space.knots(d).breaks()[element[d]], b = space.knots(d).breaks()[element[d] + 1];
        xi[d] = 0.5 * (a + b) + 0.5 * (b - a) * t[rest % 5];
        w *= 0.5 * (b - a) * weight[rest % 5];
      }
      sum += w * f(xi);
    }
  }
  return sum;
}

TEST(Primitives, SurfacesSolveTheirEquations) {
  for (const Round& round : round_surfaces()) {
    SCOPED_TRACE(round.name);
    check_patch(round.surface);
    expect_everywhere(round.surface, round.signed_distance);
  }
}

TEST(Primitives, NormalsPointOutwards) {
  for (const Round& round : round_surfaces()) {
    SCOPED_TRACE(round.name);
    shapes::Random random(3);
    for (int k = 0; k < 50; ++k) {
      const Parameter<2> xi = shapes::random_parameter(random, round.surface.space);
      const Vector3 x = interpolate(round.surface.space, round.surface.control_points, xi);
      const Vector3 n = normal_at(round.surface, xi).normalized();
      // The signed distance grows along its own normal as fast as one walks.
      EXPECT_NEAR(round.signed_distance(x + 0.01 * n), 0.01, 1e-12);
      EXPECT_NEAR(round.signed_distance(x - 0.01 * n), -0.01, 1e-12);
    }
  }
}

TEST(Primitives, Areas) {
  for (const Round& round : round_surfaces()) {
    const double area = integral<2>(
        round.surface.space, [&](const Parameter<2>& xi) { return normal_at(round.surface, xi).norm(); });
    EXPECT_NEAR(area, round.area, 1e-11 * round.area) << round.name;
  }
}

// Tube, a solid.

TEST(Primitives, TubeIsAnExactSolid) {
  const Frame f = tilted();
  const Vector3 z = f.axes.col(2);
  for (const double to : {90.0, 360.0}) {
    const Volume solid = tube(f, 1.0, 2.0, 3.0, meshed_arc(0, to, static_cast<int>(to / 15), 3),
                              {KnotVector::uniform(2, 2), KnotVector::uniform(2, 3)});
    check_patch(solid);
    shapes::Random random(4);
    for (int k = 0; k < 200; ++k) {
      const Parameter<3> xi = shapes::random_parameter(random, solid.space);
      const Vector3 x = interpolate(solid.space, solid.control_points, xi) - f.origin;
      EXPECT_NEAR(x.dot(z), 3 * xi[1], 1e-14);
      EXPECT_NEAR(x.cross(z).norm(), 1 + xi[2], 1e-14);
      EXPECT_GT(jacobian_at(solid, xi), 0.0);
    }
    const double volume =
        integral<3>(solid.space, [&](const Parameter<3>& xi) { return jacobian_at(solid, xi); });
    const double exact = to / 360 * M_PI * (4.0 - 1.0) * 3.0;
    EXPECT_NEAR(volume, exact, 1e-11 * exact);
    EXPECT_EQ(boundary_surface(solid.space, Face::zeta_plus).outward_sign, 1);
  }
}

// Seams and poles.

TEST(Primitives, AWholeTurnClosesToTheLastBit) {
  const Frame f = tilted();
  const Surface pipe = cylinder(f, 0.7, 1.5, meshed_arc(0, 360, 8), KnotVector::uniform(2, 3));
  const Surface ball = sphere(f, 1.3, meshed_arc(-77.7, 282.3, 12, 3), meshed_arc(-90, 90, 4, 4));
  const Surface ring = torus(f, 1.0, 0.4, meshed_arc(0, 360, 8, 3), meshed_arc(90, 450, 4));
  for (const Surface& surface : {pipe, ball, ring}) {
    const NodalVectors& P = surface.control_points;
    const int n = surface.space.control_point_count(0);
    for (int row = 0; row < P.cols(); row += n) EXPECT_EQ(P.col(row), P.col(row + n - 1));
  }
  const NodalVectors& P = ring.control_points;
  const int n = ring.space.control_point_count(0);
  EXPECT_EQ(P.leftCols(n), P.rightCols(n));
}

TEST(Primitives, APoleIsOnePoint) {
  const Frame f = tilted();
  const Surface ball = sphere(f, 1.3, meshed_arc(0, 360, 8, 3), meshed_arc(-90, 90, 4, 3));
  const Surface tip = cone(f, {0, 1}, 1, meshed_arc(10, 100, 8), KnotVector::uniform(2, 3));
  const int n = ball.space.control_point_count(0), last = ball.space.control_point_count();
  for (int i = 0; i < n; ++i) {
    EXPECT_EQ(ball.control_points.col(i), ball.control_points.col(0));
    EXPECT_EQ(ball.control_points.col(last - 1 - i), ball.control_points.col(last - 1));
    EXPECT_EQ(tip.control_points.col(i % tip.space.control_point_count(0)), f.origin);
  }
  EXPECT_NEAR((ball.control_points.col(0) - (f.origin - 1.3 * f.axes.col(2))).norm(), 0.0, 1e-15);
}

// Wrong arguments.

TEST(Primitives, SayWhatWasGivenAndWhatWasExpected) {
  const KnotVector line = KnotVector::uniform(2, 1);
  const Curve turn = arc(0, 360);
  const double nan = std::nan("");
  const std::vector<std::pair<std::function<void()>, const char*>> table = {
      {[] { arc(10, 10); }, "angles are [10, 10], expected [from, to] in degrees"},
      {[] { arc(0, 361); }, "angles are [0, 361]"},
      {[=] { arc(nan, 90); }, "angles are [nan, 90]"},
      {[] { refined(arc(0, 360), 6, 2); }, "6 elements on a curve of 4 pieces, expected a multiple of 4"},
      {[] { refined(arc(0, 90), 0, 2); }, "0 elements on a curve of 1 pieces"},
      {[] { refined(arc(0, 90), 1, 1); }, "degree is 1, expected 2 to 16"},
      {[] { refined(arc(0, 90), 1, 17); }, "degree is 17, expected 2 to 16"},
      {[] {
         frame({0, 0, 0}, {0, 0, 0});
       },
       "axis is [0, 0, 0], expected a direction"},
      {[] {
         frame({0, 0, 0}, {0, 0, 1}, {0, 0, -2});
       },
       "reference is [0, 0, -2], expected a direction other"},
      {[] {
         frame({0, 0, 0}, {0, 0, 1}, {0, 0, 0});
       },
       "reference is [0, 0, 0]"},
      {[=] { cylinder(upright(), -1, 1, turn, line); }, "radius is -1, expected a number > 0"},
      {[=] { cylinder(upright(), 1, 0, turn, line); }, "length is 0, expected a number > 0"},
      {[=] { cylinder(upright(), nan, 1, turn, line); }, "radius is nan, expected a number > 0"},
      {[=] {
         cone(upright(), {0, 0}, 1, turn, line);
       },
       "radii are [0, 0], expected numbers >= 0, not both 0"},
      {[=] {
         cone(upright(), {2, -1}, 1, turn, line);
       },
       "radii are [2, -1]"},
      {[=] {
         cone(upright(), {nan, 1}, 1, turn, line);
       },
       "radii are [nan, 1]"},
      {[=] { sphere(upright(), 0, turn, arc(-90, 90)); }, "radius is 0, expected a number > 0"},
      {[=] { sphere(upright(), 1, turn, arc(-90, 91)); }, "latitude goes over a pole"},
      {[=] { torus(upright(), 1, 1, turn, turn); }, "radius is 1, expected more than tube_radius 1"},
      {[=] { torus(upright(), 1, 0, turn, turn); }, "tube_radius is 0, expected a number > 0"},
      {[=] {
         tube(upright(), 2, 1, 1, turn, {line, line});
       },
       "outer_radius is 1, expected more than inner_radius 2"},
      {[=] {
         tube(upright(), 0, 1, 1, turn, {line, line});
       },
       "inner_radius is 0, expected a number > 0"},
      {[=] {
         tube(upright(), 1, 2, -1, turn, {line, line});
       },
       "length is -1, expected a number > 0"},
  };
  for (const auto& [build, message] : table) {
    SCOPED_TRACE(message);
    try {
      build();
      ADD_FAILURE() << "accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(message));
    }
  }
}

}  // namespace
}  // namespace nurbs
