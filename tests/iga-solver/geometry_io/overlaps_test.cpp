// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles that cover or pierce each other: walls by hand, and random ones on a lattice, where whole numbers
// tell without round-off.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "geometry_io/triangle_mesh.h"
#include "nurbs/types.h"

namespace geometry_io {
namespace {

using nurbs::Vector3;
using Corners = std::array<Vector3, 3>;

// As a file in single precision has them, turned so that nothing is parallel to an axis.
TriangleMesh mesh_of_triangles(const std::vector<Corners>& triangles) {
  const Eigen::AngleAxisd turn(0.7, Vector3(1.0, 2.0, -0.5).normalized());
  TriangleSoup soup;
  soup.blocks.push_back({"", 0});
  for (const Corners& corners : triangles) {
    for (const Vector3& corner : corners)
      for (const double x : Vector3(turn * corner)) soup.corners.push_back(static_cast<float>(x));
    soup.place.push_back(static_cast<int>(soup.place.size()) + 1);
  }
  return meshes_of(soup).at(0);
}

void add_square(std::vector<Corners>& wall, const Vector3& a, const Vector3& u, const Vector3& v) {
  wall.push_back({a, a + u, a + u + v});
  wall.push_back({a, a + u + v, a + v});
}
std::vector<Corners> square(const Vector3& a, const Vector3& u, const Vector3& v) {
  std::vector<Corners> wall;
  add_square(wall, a, u, v);
  return wall;
}
std::vector<Corners> operator+(std::vector<Corners> a, const std::vector<Corners>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Corners> unit_cube() {
  std::vector<Corners> wall;
  for (int d = 0; d < 3; ++d)
    for (const double at : {0.0, 1.0})
      add_square(wall, at * Vector3::Unit(d), Vector3::Unit((d + 1) % 3), Vector3::Unit((d + 2) % 3));
  return wall;
}

// n x 2n triangles, of which those at the poles have no area.
std::vector<Corners> unit_sphere(int n) {
  std::vector<Corners> wall;
  const auto at = [n](int i, int j) {
    const double phi = nurbs::kPi * (i % (2 * n)) / n, theta = nurbs::kPi * j / n;
    return Vector3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < 2 * n; ++i) {
      wall.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      wall.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return wall;
}

void expect_pairs(const std::vector<Corners>& wall, long in_plane, long piercing) {
  const Overlaps overlaps = overlaps_of(mesh_of_triangles(wall));
  EXPECT_EQ(overlaps.in_plane.count, in_plane);
  EXPECT_EQ(overlaps.piercing.count, piercing);
}

const Vector3 kX = Vector3::UnitX(), kY = Vector3::UnitY(), kZ = Vector3::UnitZ();
const std::vector<Corners> kPlate = square(-kX - kY, 2.0 * kX, 2.0 * kY);  // z = 0; its diagonal is x = y

TEST(Overlaps, AProperMeshHasNone) {
  expect_pairs(unit_cube(), 0, 0);
  expect_pairs(unit_sphere(40), 0, 0);
}

TEST(Overlaps, WhatTouchesDoesNotOverlap) {
  const Vector3 third = Vector3(1.0, 1.0 / 3.0, 0.0), corner(1.0, -1.0, 0.0);
  // T-junctions in the plane of the plate, at a fold of a half and of a hundredth, and beneath
  for (const Vector3& out :
       {Vector3(kX), Vector3(0.9 * kX + 0.5 * kZ), Vector3(kX - 0.01 * kZ), Vector3(-kZ)})
    expect_pairs(kPlate + std::vector<Corners>{{corner, third, corner + out},
                                               {third, third + out, corner + out},
                                               {third, kX + kY, third + out}},
                 0, 0);
  expect_pairs(kPlate + square(0.2 * kX - 0.5 * kY, kY, kZ), 0, 0);                 // a rib on the plate
  expect_pairs(kPlate + std::vector<Corners>{{0.3 * kX, kX + kZ, kY + kZ}}, 0, 0);  // a tip on it
  expect_pairs(kPlate + square(-kX - kY + 1e-5 * kZ, 2.0 * kX, 2.0 * kY), 0, 0);    // a plate beside it
  expect_pairs(kPlate + square(kX + 0.1 * kY - kZ, -0.5 * kZ, kX), 0, 0);           // far away
}

TEST(Overlaps, CoplanarTrianglesThatCoverEachOther) {
  expect_pairs(kPlate + square(0.3 * kX - 0.6 * kY, 0.2 * kX, 0.2 * kY), 2, 0);  // inside one triangle
  expect_pairs(kPlate + square(-0.2 * kX - 0.1 * kY, 0.3 * kX, 0.3 * kY), 3,
               0);  // over the diagonal; one of two
  // the other diagonal: each of two covers half of each of two, and shares a side with it
  expect_pairs(kPlate + std::vector<Corners>{{-kX - kY, kX - kY, kY - kX}, {kX - kY, kX + kY, kY - kX}}, 4,
               0);
  // beyond a shared side, on the side where a triangle is already; over a shared corner
  expect_pairs(kPlate + std::vector<Corners>{{-kX - kY, kX + kY, 0.9 * kX - 0.7 * kY}}, 1, 0);
  expect_pairs(kPlate + std::vector<Corners>{{-kX - kY, 0.5 * kX - 0.5 * kY, 0.5 * kX - 0.9 * kY}}, 1, 0);
  // tilted by less than the tolerance, 2.8e-6, and by more
  expect_pairs(kPlate + square(0.3 * kX - 0.6 * kY, 0.2 * kX, 0.2 * kY + 1e-6 * kZ), 2, 0);
  expect_pairs(kPlate + square(0.3 * kX - 0.6 * kY + 1e-5 * kZ, 0.2 * kX, 0.2 * kY), 0, 0);
  // whose own plane, 2e-6 over 0.01, leaves the plate's far corners behind, before and after it in the file
  const auto tilted = square(0.3 * kX - 0.6 * kY, 0.01 * kX, 0.01 * kY + 2e-6 * kZ);
  expect_pairs(kPlate + tilted, 2, 0);
  expect_pairs(tilted + kPlate, 2, 0);
}

TEST(Overlaps, TrianglesThatPierceEachOther) {
  // At x = 0.2 the plate's triangles meet x = y at 0.2, those of the other plate y = z at 0.
  expect_pairs(kPlate + square(0.2 * kX - kY - kZ, 2.0 * kY, 2.0 * kZ), 0, 3);
  expect_pairs(kPlate + std::vector<Corners>{{0.5 * kX - kZ, 0.6 * kX + kZ, 0.4 * kX + kZ}}, 0, 1);
  // from a shared corner
  expect_pairs(kPlate + std::vector<Corners>{{-kX - kY, 0.5 * kX + kZ, 0.5 * kX - kZ}}, 0, 1);
  // a tip that stands across the plate's rim, in it by more, and by less than 1e-6 of the size
  for (const auto& [in, pairs] : {std::pair(1e-4, 1L), std::pair(1e-6, 0L)})
    expect_pairs(kPlate + std::vector<Corners>{{(1.0 - in) * kX, 2.0 * kX + kZ, 2.0 * kX - kZ}}, 0, pairs);
  // a rib through it by more, and by less than 1e-6 of the size
  for (const auto& [through, pairs] : {std::pair(1e-4, 2L), std::pair(1e-6, 0L)})
    expect_pairs(kPlate + square(0.2 * kX - 0.9 * kY - through * kZ, kY, kZ), 0, pairs);
}

TEST(Overlaps, TheFirstPairIsShown) {
  const Overlaps overlaps = overlaps_of(mesh_of_triangles(unit_cube() + square(5.0 * kX, kX, kY) +
                                                          square(Vector3(5.6, 0.1, 0), 0.2 * kX, 0.2 * kY) +
                                                          square(Vector3(0.5, 0.1, -0.5), 0.1 * kX, kZ)));
  EXPECT_EQ(overlaps.in_plane.count, 2);
  EXPECT_EQ(overlaps.in_plane.first, 12);
  EXPECT_EQ(overlaps.in_plane.second, 14);
  EXPECT_GT(overlaps.piercing.count, 0);
  EXPECT_LT(overlaps.piercing.first, 12);
  EXPECT_GE(overlaps.piercing.second, 16);
}

// On a lattice: whole numbers, exact.
using Lattice = std::array<std::int64_t, 3>;
using LatticeTriangle = std::array<Lattice, 3>;

std::int64_t lattice_volume(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
  std::int64_t m[3][3];
  for (int k = 0; k < 3; ++k) m[0][k] = b[k] - a[k], m[1][k] = c[k] - a[k], m[2][k] = d[k] - a[k];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
// Whether a side of t goes through the inside of u.
bool side_goes_through(const LatticeTriangle& t, const LatticeTriangle& u) {
  for (int i = 0; i < 3; ++i) {
    const Lattice &p = t[i], &q = t[(i + 1) % 3];
    if ((lattice_volume(u[0], u[1], u[2], p) > 0) == (lattice_volume(u[0], u[1], u[2], q) > 0)) continue;
    const bool turn = lattice_volume(p, q, u[0], u[1]) > 0;
    if (turn == (lattice_volume(p, q, u[1], u[2]) > 0) && turn == (lattice_volume(p, q, u[2], u[0]) > 0))
      return true;
  }
  return false;
}
std::int64_t lattice_area(const Lattice& a, const Lattice& b, const Lattice& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
// Whether a line along a side of t, in the plane of x and y, has nothing of u on its side.
bool side_parts(const LatticeTriangle& t, const LatticeTriangle& u) {
  for (int i = 0; i < 3; ++i) {
    const Lattice &p = t[i], &q = t[(i + 1) % 3];
    const std::int64_t sign = lattice_area(t[0], t[1], t[2]) > 0 ? 1 : -1;
    bool parts = true;
    for (const Lattice& x : u) parts = parts && sign * lattice_area(p, q, x) <= 0;
    if (parts) return true;
  }
  return false;
}

// Triangles in a plane, of few numbers: what overlaps does by more than the tolerance; or in space, of many:
// hardly any touch.
std::vector<LatticeTriangle> random_triangles(std::mt19937& random, int count, bool flat) {
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution<>(low, high)(random); };
  const int width = flat ? 100 : 10000;
  std::vector<LatticeTriangle> found;
  while (static_cast<int>(found.size()) < count) {
    const Lattice middle{whole(0, width), whole(0, width), flat ? 0 : whole(0, width)};
    LatticeTriangle t;
    for (Lattice& x : t)
      for (int k = 0; k < 3; ++k) x[k] = middle[k] + (flat && k == 2 ? 0 : whole(-width / 5, width / 5));
    if (std::abs(lattice_area(t[0], t[1], t[2])) > width * width / 50) found.push_back(t);
  }
  return found;
}

TEST(Overlaps, RandomTrianglesAsWholeNumbersTell) {
  std::mt19937 random(1);
  for (const bool flat : {false, true}) {
    const std::vector<LatticeTriangle> all = random_triangles(random, 300, flat);
    long expected = 0;
    for (size_t i = 0; i < all.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        expected += flat ? !side_parts(all[i], all[j]) && !side_parts(all[j], all[i])
                         : side_goes_through(all[i], all[j]) || side_goes_through(all[j], all[i]);
    std::vector<Corners> wall;
    for (const LatticeTriangle& t : all) {
      wall.emplace_back();
      for (int i = 0; i < 3; ++i)
        wall.back()[i] =
            Vector3(static_cast<double>(t[i][0]), static_cast<double>(t[i][1]), static_cast<double>(t[i][2]));
    }
    EXPECT_GT(expected, 100);
    expect_pairs(wall, flat ? expected : 0, flat ? 0 : expected);
  }
}

}  // namespace
}  // namespace geometry_io
