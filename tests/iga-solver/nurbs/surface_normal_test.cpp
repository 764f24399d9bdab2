// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_normal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "nurbs/shapes.h"

namespace nurbs {
namespace {

Vector3 normal(const PatchedSurface& surface, int patch, double xi, double eta) {
  return normal_at(surface.topology, surface.control_points, {patch, {xi, eta}});
}
void expect_near(const Vector3& given, const Vector3& expected, double tolerance = 1e-12) {
  EXPECT_LT((given - expected.normalized()).norm(), tolerance)
      << given.transpose() << ", expected " << expected.normalized().transpose();
}

// The same shape with xi run backwards: the normal turns round.
Surface turned_round(const Surface& surface) {
  const KnotVector& given = surface.space.knots(0);
  std::vector<double> knots;
  for (const double knot : given.knots()) knots.push_back(given.front() + given.back() - knot);
  std::reverse(knots.begin(), knots.end());
  const int n = surface.space.control_point_count(0);
  NodalVectors points = surface.control_points;
  std::vector<double> weights = surface.space.weights();
  for (int a = 0; a < points.cols(); ++a) {
    const int b = a - a % n + n - 1 - a % n;
    points.col(a) = surface.control_points.col(b);
    if (!weights.empty()) weights[a] = surface.space.weight(b);
  }
  return {Space<2>({KnotVector(given.degree(), knots), surface.space.knots(1)}, weights), points};
}

TEST(SurfaceNormal, InsideASmoothPatchIsThatOfTheTangents) {
  shapes::Random random(3);
  for (int k = 0; k < 20; ++k) {
    const PatchedSurface surface = join({shapes::random_patch<2>(random, 4, 3, k % 2 == 1)});
    const SurfacePoint at{0, shapes::random_parameter(random, surface.topology.patch(0))};
    expect_near(normal_at(surface.topology, surface.control_points, at),
                shape_at(surface.topology, surface.control_points, at).normal, 1e-11);
  }
}

TEST(SurfaceNormal, OfASphereIsRadialEverywhere) {
  const Frame place = frame({0.1, -0.2, 0.3}, {1, 2, 2});
  const Surface one = sphere(place, 0.7, refined(arc(0, 360), 8, 3), refined(arc(-90, 90), 4, 2));
  std::vector<Surface> many;
  for (const auto& [from, to] : {std::pair(0.0, 50.0), std::pair(50.0, 200.0), std::pair(200.0, 360.0)})
    for (const double south : {-90.0, 0.0})
      many.push_back(sphere(place, 0.7, arc(from, to), arc(south, south + 90.0)));
  for (const bool inwards : {false, true})
    for (std::vector<Surface> patches : {std::vector<Surface>{one}, many}) {
      if (inwards) patches[0] = turned_round(patches[0]);
      const PatchedSurface ball = join(patches);
      for (int p = 0; p < ball.topology.patch_count(); ++p)
        for (const double u : {0.0, 1e-13, 0.125, 0.3, 0.5, 1.0 - 1e-13, 1.0})
          for (const double v : {0.0, 1e-17, 1e-9, 0.25, 0.5, 0.77, 1.0 - 1e-16, 1.0}) {
            const Vector3 S = interpolate(ball.topology.patch(p),
                                          ball.topology.control_points_of(p, ball.control_points), {u, v});
            expect_near(normal(ball, p, u, v), (inwards && p == 0 ? -1.0 : 1.0) * (S - place.origin),
                        v == 1e-9 ? 1e-8 : 1e-12);
          }
    }
}

// All normals of the cone make the same angle with its axis, whatever pieces it is made of.
TEST(SurfaceNormal, AtTheTipOfAConeIsTheAxis) {
  const Frame place = frame({0.1, 0.2, 0.3}, {2, -1, 2}, {1, 0, 0});
  const auto part = [&](double from, double to) {
    return cone(place, {0.0, 0.8}, 1.3, arc(from, to), KnotVector::uniform(1, 2));
  };
  Surface whole = part(0, 360);
  for (const double xi : {0.03, 0.11, 0.4}) whole = insert_knot(whole, 0, xi);
  const Surface thirds[] = {part(0, 40), part(40, 250), part(250, 360)};
  const Vector3 out = -place.axes.col(2);  // the tip is the lower end
  for (const double xi : {0.0, 0.2, 0.25, 1.0}) {
    expect_near(normal(join({whole}), 0, xi, 0.0), out, 1e-10);
    expect_near(normal(join({turned_round(whole)}), 0, xi, 0.0), -out, 1e-10);
    const PatchedSurface cut = join({thirds[0], turned_round(thirds[1]), thirds[2]});
    for (const int p : {0, 1, 2}) expect_near(normal(cut, p, xi, 0.0), p == 1 ? Vector3(-out) : out, 1e-10);
  }
  // Half a cone: the mean of its own normals, the integral over half a turn.
  const double slope = 0.8 / 1.3;  // normals (cos, sin, -slope)
  expect_near(normal(join({part(0, 180)}), 0, 0.3, 0.0), place.axes * Vector3(0.0, 2.0, -kPi * slope), 1e-10);
}

TEST(SurfaceNormal, OnEdgesAndCornersOfACubeIsTheirBisector) {
  const std::array<KnotVector, 2> two{KnotVector::uniform(2, 2), KnotVector::uniform(1, 3)};
  for (int inwards = 0; inwards < 64; ++inwards) {  // a bit for each face
    std::vector<Surface> faces;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Vector3 u = Vector3::Zero(), v = u, origin = Vector3::Zero();
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1.0;
        origin[axis] = side;
        Surface face = side == 1 ? plane(origin, u, v, two) : plane(origin, v, u, two);
        const bool turn = (inwards >> faces.size() & 1) != 0;
        faces.push_back(turn ? turned_round(face) : face);
      }
    const PatchedSurface cube = join(faces);
    for (int p = 0; p < 6; ++p)
      for (const double xi : {0.0, 0.3, 0.5, 1.0})
        for (const double eta : {0.0, 1.0 / 3.0, 0.9, 1.0}) {
          const Vector3 S = interpolate(cube.topology.patch(p),
                                        cube.topology.control_points_of(p, cube.control_points), {xi, eta});
          Vector3 out;
          for (int i = 0; i < 3; ++i) out[i] = S[i] < 1e-9 ? -1.0 : S[i] > 1.0 - 1e-9 ? 1.0 : 0.0;
          expect_near(normal(cube, p, xi, eta), (inwards >> p & 1) != 0 ? Vector3(-out) : out);
        }
  }
}

// A roof of one patch, its ridge a C0 line; knots on one side of it, or beside it by round-off, change
// nothing.
TEST(SurfaceNormal, OnAKinkIsTheBisectorHoweverItIsCutIntoElements) {
  const double ridge = 1.0 / 3.0;
  Surface roof{Space<2>({KnotVector(1, {0, 0, ridge, 1, 1}), KnotVector(1, {0, 0, 1, 1})}),
               NodalVectors(3, 6)};
  roof.control_points << 0, 3, 4, 0, 3, 4, 0, 0, 0, 5, 5, 5, 0, 4, 4, 0, 4, 4;
  const Vector3 bisector = Vector3(-0.8, 0.0, 0.6) + Vector3(0.0, 0.0, 1.0);
  for (const bool cut : {false, true}) {
    if (cut) roof = insert_knot(roof, 1, 0.4);
    if (cut) roof = insert_knot(roof, 0, 0.6);
    const PatchedSurface sheet = join({roof});
    for (const double off : {-1e-16, 0.0, 1e-16})
      for (const double eta : {0.0, 0.3, 0.4, 1.0}) expect_near(normal(sheet, 0, ridge + off, eta), bisector);
    expect_near(normal(sheet, 0, ridge - 1e-6, 0.4), {-0.8, 0.0, 0.6});
    expect_near(normal(sheet, 0, 0.6, 0.4), {0, 0, 1});
  }
  // The same of two patches, one turned round, with parameters that do not meet to the last bit.
  const PatchedSurface two =
      join({plane({0, 0, 0}, {3, 0, 4}, {0, 5, 0}, {KnotVector::uniform(2, 3), KnotVector::uniform(2, 3)}),
            turned_round(plane({3, 0, 4}, {1, 0, 0}, {0, 5, 0},
                               {KnotVector::uniform(1, 1), KnotVector::uniform(2, 3, -7.0, 0.1)}))});
  for (const double t : {0.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0}) {
    expect_near(normal(two, 0, 1.0, t), bisector);
    expect_near(normal(two, 1, 1.0, -7.0 + 7.1 * t), -bisector);
  }
}

// A disc of one patch: both tangents are the rim's at its four corners.
TEST(SurfaceNormal, WhereTheTangentsAreParallelIsTheLimitFromInside) {
  const double w = std::sqrt(0.5);
  Surface disc{Space<2>({KnotVector::uniform(2, 1), KnotVector::uniform(2, 1)}, {1, w, 1, w, 1, w, 1, w, 1}),
               NodalVectors(3, 9)};
  disc.control_points << -w, 0, w, -2 * w, 0, 2 * w, -w, 0, w,  //
      -w, -2 * w, -w, 0, 0, 0, w, 2 * w, w,                     //
      0, 0, 0, 0, 0, 0, 0, 0, 0;
  for (const double xi : {0.0, 0.5, 1.0})
    for (const double eta : {0.0, 0.5, 1.0}) {
      expect_near(normal(join({disc}), 0, xi, eta), {0, 0, 1});
      expect_near(normal(join({turned_round(disc)}), 0, xi, eta), {0, 0, -1});
    }
}

TEST(SurfaceNormal, HasLengthOneWhereThereIsNone) {
  // A sheet folded flat: its own side of the fold; a surface drawn together in a line or a point.
  const std::array<KnotVector, 2> knots{KnotVector::uniform(2, 2), KnotVector::uniform(2, 2)};
  const Surface sheet = plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, knots);
  const PatchedSurface fold = join({sheet, plane({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, knots)});
  expect_near(normal(fold, 0, 0.0, 0.3), {0, 0, 1});
  expect_near(normal(fold, 1, 0.3, 0.0), {0, 0, -1});
  for (const Vector3& left : {Vector3(1, 0, 0), Vector3(0, 0, 0)}) {
    Surface flat = sheet;
    flat.control_points = left.asDiagonal() * sheet.control_points;
    const PatchedSurface none = join({flat});
    for (const double xi : {0.0, 0.5, 0.7, 1.0})
      for (const double eta : {0.0, 0.4, 1.0}) EXPECT_NEAR(normal(none, 0, xi, eta).norm(), 1.0, 1e-12);
  }
  // A pole with no tangent into the patch either (its next row is the same point).
  Surface tip = cone(frame({0, 0, 0}, {0, 0, 1}), {0.0, 1.0}, 1.0, arc(0, 360), KnotVector::uniform(1, 1));
  tip = elevate_degree(tip, 1, 1);
  const int n = tip.space.control_point_count(0);
  tip.control_points.middleCols(n, n) = tip.control_points.leftCols(n);
  expect_near(normal(join({tip}), 0, 0.2, 0.0), {0, 0, -1});
}

}  // namespace
}  // namespace nurbs
