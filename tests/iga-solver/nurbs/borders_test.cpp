// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/borders.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "nurbs/primitives.h"
#include "nurbs/refinement.h"

namespace nurbs {
namespace {

constexpr double kPi = 3.14159265358979323846;

KnotVector knots(int degree, int elements) { return KnotVector::uniform(degree, elements); }

Surface square(const Vector3& origin, const Vector3& u, const Vector3& v, int degree = 2, int elements = 3) {
  return plane(origin, u, v, {knots(degree, elements), knots(degree, elements)});
}

Vector3 edge_point(const Surface& surface, int side, double t) {
  Parameter<2> xi;
  xi[side / 2] = side % 2;
  xi[1 - side / 2] = t;
  return interpolate(surface.space, surface.control_points, xi);
}

// The two pieces of a surface cut at xi.
std::vector<Surface> cut(const Surface& surface, double xi) {
  const int p = surface.space.degree(0);
  const Surface whole = insert_knot(surface, 0, xi, p);
  const std::vector<double>& u = whole.space.knots(0).knots();
  const int first = static_cast<int>(std::lower_bound(u.begin(), u.end(), xi) - u.begin());  // knots below xi
  const int n = whole.space.control_point_count(0), n_eta = whole.space.control_point_count(1);
  std::vector<Surface> pieces;
  for (const bool upper : {false, true}) {
    std::vector<double> part(u.begin() + (upper ? first : 0), upper ? u.end() : u.begin() + first + p);
    part.insert(upper ? part.begin() : part.end(), xi);
    const int begin = upper ? first - 1 : 0, count = upper ? n - begin : first;
    NodalVectors points(3, count * n_eta);
    std::vector<double> weights(count * n_eta);
    for (int j = 0; j < n_eta; ++j)
      for (int i = 0; i < count; ++i) {
        points.col(i + count * j) = whole.control_points.col(begin + i + n * j);
        weights[i + count * j] = whole.space.weight(begin + i + n * j);
      }
    pieces.push_back({Space<2>({KnotVector(p, part), whole.space.knots(1)}, weights), points});
  }
  return pieces;
}

Surface wavy() {
  Surface surface = square({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 3, 4);
  for (Eigen::Index a = 0; a < surface.control_points.cols(); ++a)
    surface.control_points(2, a) = 0.3 * std::sin(1.7 * static_cast<double>(a));
  return surface;
}

void expect_seam(const Border& border, int patch, int side) {
  EXPECT_EQ(border.kind, Border::welded);
  EXPECT_EQ(border.patch, patch);
  EXPECT_EQ(border.side, side);
  EXPECT_FALSE(border.reversed);
  EXPECT_LT(border.max_angle, 1e-14);
}

TEST(Borders, CylinderHasASeamAndTwoRims) {
  const auto borders = find_borders(
      {cylinder(frame({1, 2, 3}, {1, 1, 0}), 0.5, 2.0, refined(arc(0, 360), 8, 3), knots(2, 3))});
  expect_seam(borders[0][0], 0, 1);
  expect_seam(borders[0][1], 0, 0);
  EXPECT_LT(borders[0][0].max_jump, 1e-13);
  EXPECT_EQ(borders[0][2].kind, Border::free);
  EXPECT_EQ(borders[0][3].kind, Border::free);
}

TEST(Borders, SphereHasPolesAndTheSeamBetweenThemIsSmooth) {
  const auto borders = find_borders({sphere(frame({0.1, 0.2, 0.3}, {1, 2, 2}), 0.5,
                                            refined(arc(0, 360), 12, 4), refined(arc(-90, 90), 6, 3))});
  expect_seam(borders[0][0], 0, 1);
  EXPECT_EQ(borders[0][2].kind, Border::pole);
  EXPECT_EQ(borders[0][3].kind, Border::pole);
}

// With noise as from a file of 12 digits: at the poles there is no normal, only noise that differs between
// the halves.
TEST(Borders, HalfSpheresMeetSmoothlyUpToThePoles) {
  const Frame place = frame({0.1, 0.2, 0.3}, {1, 2, 2});
  std::vector<Surface> halves{sphere(place, 0.5, refined(arc(0, 180), 6, 4), refined(arc(-90, 90), 6, 3)),
                              sphere(place, 0.5, refined(arc(180, 360), 10, 3), arc(-90, 90))};
  int i = 0;
  for (Surface& half : halves)
    for (double& x : half.control_points.reshaped()) x += 1e-12 * std::sin(++i);
  const auto borders = find_borders(halves);
  for (const auto& [side, other] : {std::pair(0, 1), std::pair(1, 0)}) {
    EXPECT_EQ(borders[0][side].kind, Border::welded);
    EXPECT_EQ(borders[0][side].side, other);
    EXPECT_LT(borders[0][side].max_angle, 1e-9);
  }
  for (const int side : {2, 3}) EXPECT_EQ(borders[1][side].kind, Border::pole);
}

TEST(Borders, TorusHasTwoSeams) {
  const auto borders = find_borders({torus(frame({0, 0, 0}, {0, 0, 1}), 3.0, 1.0, arc(0, 360), arc(0, 360))});
  expect_seam(borders[0][0], 0, 1);
  expect_seam(borders[0][2], 0, 3);
}

TEST(Borders, PartOfATurnHasNoSeam) {
  const auto borders =
      find_borders({cylinder(frame({0, 0, 0}, {0, 0, 1}), 0.5, 2.0, arc(0, 359), knots(1, 1))});
  for (const Border& border : borders[0]) EXPECT_EQ(border.kind, Border::free);
}

// A square and its neighbour beyond xi+, bent up by an angle, with all eight parametrisations of the
// neighbour.
TEST(Borders, EveryWayTwoEdgesMeet) {
  for (const double angle : {0.0, 0.3, 2.0}) {
    const Surface here = square({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Vector3 across(std::cos(angle), 0, std::sin(angle)), along(0, 1, 0), corner(1, 0, 0);
    int same = 0;
    for (int way = 0; way < 8; ++way) {
      Vector3 origin = corner, u = across, v = along;
      if (way & 1) origin += u, u = -u;
      if (way & 2) origin += v, v = -v;
      if (way & 4) std::swap(u, v);
      const Surface there = square(origin, u, v, 3, 2);
      const auto borders = find_borders({here, there});
      const Border& border = borders[0][1];
      ASSERT_EQ(border.kind, Border::welded) << way;
      ASSERT_EQ(border.patch, 1);
      for (double t : {0.0, 0.2, 1.0})
        EXPECT_LT(
            (edge_point(here, 1, t) - edge_point(there, border.side, border.reversed ? 1 - t : t)).norm(),
            1e-14);
      EXPECT_NEAR(border.max_angle, angle, 1e-14) << way;
      const bool normals_agree = std::abs(u.cross(v).dot(across.cross(along)) - 1.0) < 1e-12;
      EXPECT_EQ(same_orientation(1, border), normals_agree) << way;
      same += normals_agree;
      const Border& back = borders[1][border.side];
      EXPECT_EQ(back.kind, Border::welded);
      EXPECT_EQ(back.patch, 0);
      EXPECT_EQ(back.side, 1);
      EXPECT_EQ(back.reversed, border.reversed);
      EXPECT_EQ(same_orientation(border.side, back), normals_agree);
    }
    EXPECT_EQ(same, 4);
  }
}

TEST(Borders, APatchFoldedBackOnItselfMeetsAtPi) {
  const auto borders =
      find_borders({square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), square({1, 0, 0}, {-2, 0, 0}, {0, 1, 0})});
  ASSERT_EQ(borders[0][1].kind, Border::welded);
  EXPECT_NEAR(borders[0][1].max_angle, kPi, 1e-14);
}

TEST(Borders, CutSurfaceIsC1WhateverTheRepresentation) {
  std::vector<Surface> pieces = cut(wavy(), 0.375);
  pieces[1] = elevate_degree(insert_knots(pieces[1], 1, {0.1, 0.1, 0.77}), 1);
  const auto borders = find_borders(pieces);
  expect_seam(borders[0][1], 1, 0);
  EXPECT_LT(borders[0][1].max_jump, 1e-12);
  EXPECT_EQ(borders[0][0].kind, Border::free);
  EXPECT_EQ(borders[1][1].kind, Border::free);
}

// A board of squares, each laid down in one of eight ways: so many that to hold each edge against each would
// take longer than all other tests here.
TEST(Borders, OfManyPatchesFindTheirNeighbours) {
  constexpr int kFields = 120;
  std::mt19937 random(5);
  std::vector<Surface> board;
  for (int j = 0; j < kFields; ++j)
    for (int i = 0; i < kFields; ++i) {
      const unsigned way = random() % 8;
      Vector3 u(way & 1 ? -1 : 1, 0, 0), v(0, way & 2 ? -1 : 1, 0);
      const Vector3 corner(i + (way & 1 ? 1 : 0), j + (way & 2 ? 1 : 0), 0);
      if (way & 4) std::swap(u, v);
      board.push_back(square(corner, u, v, 1, 1));
    }
  const auto borders = find_borders(board);
  int welded = 0;
  for (size_t p = 0; p < board.size(); ++p)
    for (int side = 0; side < kSideCount; ++side) {
      const Border& border = borders[p][side];
      const Vector3 middle = edge_point(board[p], side, 0.5);
      const auto on_rim = [](double x) { return x == 0.0 || x == kFields; };
      ASSERT_EQ(border.kind, on_rim(middle[0]) || on_rim(middle[1]) ? Border::free : Border::welded);
      if (border.kind == Border::free) continue;
      ++welded;
      ASSERT_NE(border.patch, static_cast<int>(p));
      ASSERT_EQ(edge_point(board[border.patch], border.side, 0.5), middle);
      ASSERT_EQ(edge_point(board[border.patch], border.side, border.reversed ? 1.0 : 0.0),
                edge_point(board[p], side, 0.0));
    }
  EXPECT_EQ(welded, 4 * kFields * (kFields - 1));
}

// Normals agree along the border; the derivatives across it do not.
TEST(Borders, GeometricallySmoothIsNotC1) {
  const auto borders =
      find_borders({square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), square({1, 0, 0}, {1, 1, 0}, {0, 1, 0})});
  expect_seam(borders[0][1], 1, 0);
  EXPECT_NEAR(borders[0][1].max_jump, std::sqrt(0.5), 1e-14);  // |(1,1) - (1,0)| / |(1,1)|
}

TEST(Borders, EdgesOfDifferentCourseOrParametrisationStayFree) {
  const Surface here = square({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Surface bulged = square({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  bulged.control_points(2, 2 * bulged.space.control_point_count(0)) = 1e-6;  // same ends
  EXPECT_EQ(find_borders({here, bulged})[0][1].kind, Border::free);
  EXPECT_EQ(find_borders({here, bulged}, 1e-5)[0][1].kind, Border::welded);

  Surface uneven = square({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  uneven.control_points(1, 2 * uneven.space.control_point_count(0)) += 0.1;  // same line, another speed
  EXPECT_EQ(find_borders({here, uneven})[0][1].kind, Border::free);
}

// They meet at their ends and in the middle, where polynomials of these degrees would be the same.
TEST(Borders, AnArcIsNotTheParabolaThroughItsMiddle) {
  const Surface round = cylinder(frame({0, 0, 0}, {0, 0, 1}), 1.0, 1.0, arc(0, 90), knots(1, 1));
  Surface parabolic = cylinder(frame({0, 0, 1}, {0, 0, 1}), 1.0, 1.0, arc(0, 90), knots(1, 1));
  parabolic.space = Space<2>(parabolic.space.knots());  // no weights
  for (const int a : {1, 4}) parabolic.control_points.col(a).head<2>().setConstant(std::sqrt(2.0) - 0.5);
  for (const double t : {0.0, 0.5, 1.0})
    ASSERT_LT((edge_point(round, 3, t) - edge_point(parabolic, 2, t)).norm(), 1e-14);
  EXPECT_EQ(find_borders({round, parabolic})[0][3].kind, Border::free);
  EXPECT_EQ(find_borders({parabolic, round})[0][2].kind, Border::free);
}

// A tooth between the points at which a coarser edge would be looked at, whichever way its own edge runs.
TEST(Borders, KnotsOfBothEdgesCount) {
  const Surface here = square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
  for (const bool reversed : {false, true}) {
    Surface toothed = plane({1, reversed ? 1.0 : 0.0, 0}, {1, 0, 0}, {0, reversed ? -1.0 : 1.0, 0},
                            {knots(1, 1), KnotVector(1, {0, 0, 0.1, 0.2, 1, 1})});
    EXPECT_EQ(find_borders({here, toothed})[0][1].reversed, reversed);
    toothed.control_points(2, toothed.space.control_point_count(0)) = 0.1;  // at 0.1
    EXPECT_EQ(find_borders({here, toothed})[0][1].kind, Border::free) << reversed;
    EXPECT_EQ(find_borders({toothed, here})[0][0].kind, Border::free) << reversed;
  }
}

TEST(Borders, OfThreeEdgesTheSmoothestPairWelds) {
  const auto borders =
      find_borders({square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), square({1, 0, 0}, {0, 0, 1}, {0, 1, 0}),
                    square({1, 0, 0}, {1, 0, 0.1}, {0, 1, 0})});
  EXPECT_EQ(borders[0][1].patch, 2);
  EXPECT_EQ(borders[2][0].patch, 0);
  EXPECT_EQ(borders[1][0].kind, Border::free);
}

// The rims of stacked half cylinders meet side by side and one on the other: every border is the right one.
TEST(Borders, FourPiecesOfACylinder) {
  std::vector<Surface> pieces;
  for (double z : {0.0, 2.0})
    for (double from : {0.0, 180.0})
      pieces.push_back(cylinder(frame({0, 0, z}, {0, 0, 1}), 0.5, 2.0,
                                refined(arc(from, from + 180), 2 + 2 * (z > 0), 2), knots(1 + (z > 0), 2)));
  const auto borders = find_borders(pieces);
  expect_seam(borders[0][0], 1, 1);
  expect_seam(borders[0][1], 1, 0);
  EXPECT_EQ(borders[0][2].kind, Border::free);
  expect_seam(borders[0][3], 2, 2);
  expect_seam(borders[3][2], 1, 3);
  EXPECT_EQ(borders[3][3].kind, Border::free);
}

// Two patches, one turned round, fill a periodic box: the neighbour's edge, moved, is the patch's own.
TEST(Borders, TranslationsAcrossPeriodicFaces) {
  const std::vector<Surface> patches = {square({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                        square({2, 1, 0}, {-1, 0, 0}, {0, -1, 0}, 3, 2)};
  const auto borders = find_borders(patches, 1e-9, {{2, 0, 0}, {0, 1, 0}});
  for (const int patch : {0, 1})
    for (int side = 0; side < kSideCount; ++side) {
      const Border& border = borders[patch][side];
      ASSERT_EQ(border.kind, Border::welded) << patch << ' ' << side_name(side);
      for (const double t : {0.0, 0.3, 1.0}) {
        const Vector3 there = edge_point(patches[border.patch], border.side, border.reversed ? 1.0 - t : t);
        EXPECT_LT((there + border.translation - edge_point(patches[patch], side, t)).norm(), 1e-14)
            << patch << ' ' << side_name(side);
      }
    }
}

TEST(Borders, NoPatches) { EXPECT_TRUE(find_borders({}).empty()); }

}  // namespace
}  // namespace nurbs
