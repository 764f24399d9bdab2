// SPDX-License-Identifier: GPL-2.0-or-later
// Walls of triangles for tests: simple ones, and random ones.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "brep/builder.h"

namespace brep::trials {

using nurbs::NodalVectors;
using nurbs::Vector3;

/// Triangles share points by their numbers.
struct Wall {
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;

  NodalVectors coordinates() const;
  std::vector<int> corners() const;
  /// The number of this point; a new one if it is not there.
  int point(const Vector3& x);
  void add_triangle(const Vector3& a, const Vector3& b, const Vector3& c);
  void add_quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);
  void move_points(double by, std::mt19937& random);
};

inline Surface built(const Wall& wall) { return from_triangles(wall.coordinates(), wall.corners()); }

/// Surface of the cells (numbers of three coordinates) of a grid of unit cubes.
Wall cells(const std::vector<std::array<int, 3>>& filled);
Wall cube();
Wall l_profile();
Wall open_box();
/// n x n quads over the unit square, at heights height(x, y).
template <class Height>
Wall field(int n, Height height) {
  Wall wall;
  const auto at = [&](int i, int j) {
    const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
    return Vector3(x, y, height(x, y));
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) wall.add_quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return wall;
}
/// Plates of width 1 that meet in the z axis at these angles [rad], in `height` pieces.
Wall plates(const std::vector<double>& angles, int pieces = 1);

/// Random ones, by turns: convex; cells in place, moved a little, moved much; fields, nearly flat and rough;
/// plates; any of these with holes.
constexpr int kFamilies = 8;
const char* family_name(int family);
Wall random_wall(std::mt19937& random, int family);

inline double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline int whole(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}
Vector3 random_direction(std::mt19937& random);
/// In space near a wall, beside edges and vertices, on planes of faces, on planes between two.
constexpr int kPlaces = 6;
Vector3 random_point(std::mt19937& random, const Wall& wall, int place);

}  // namespace brep::trials
