// SPDX-License-Identifier: GPL-2.0-or-later
#include "trial_walls.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace brep::trials {
namespace {

using Cell = std::array<int, 3>;

// Hull of random points: every three of them that have all others on one side.
Wall convex(std::mt19937& random) {
  std::vector<Vector3> x;
  const int count = whole(random, 5, 14);
  for (int i = 0; i < count; ++i) x.push_back(random_direction(random) * uniform(random, 0.6, 1.0));
  Wall wall;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        const Vector3 n = (x[j] - x[i]).cross(x[k] - x[i]);
        int above = 0, below = 0;
        for (int m = 0; m < count; ++m) {
          const double height = n.dot(x[m] - x[i]);
          if (m != i && m != j && m != k) ++(height > 0.0 ? above : below);
        }
        if (above > 0 && below > 0) continue;
        if (above == 0)
          wall.add_triangle(x[i], x[j], x[k]);
        else
          wall.add_triangle(x[i], x[k], x[j]);
      }
  return wall;
}

Wall random_cells(std::mt19937& random) {
  std::vector<Cell> filled{{0, 0, 0}};
  const int count = whole(random, 3, 12);
  for (int k = 0; k < count; ++k)
    filled.push_back({whole(random, 0, 2), whole(random, 0, 2), whole(random, 0, 2)});
  return cells(filled);
}

Wall random_field(std::mt19937& random, double height) {
  const int n = whole(random, 3, 6);
  return field(n, [&](double, double) { return uniform(random, -height, height) / n; });
}

Wall random_plates(std::mt19937& random) {
  std::vector<double> angles;
  const int count = whole(random, 2, 6);
  for (int k = 0; k < count; ++k) angles.push_back(uniform(random, 0.0, 6.28));
  if (count > 2) angles[1] = angles[0] + 3.141592653589793;
  return plates(angles, whole(random, 1, 3));
}

void make_holes(Wall& wall, std::mt19937& random) {
  std::shuffle(wall.triangles.begin(), wall.triangles.end(), random);
  wall.triangles.resize(std::max<size_t>(1, wall.triangles.size() * 4 / 5));
  for (auto& t : wall.triangles)
    if (random() % 2 == 0) std::swap(t[0], t[1]);
}

void turn(Wall& wall, std::mt19937& random) {
  const Eigen::AngleAxisd rotation(uniform(random, 0.0, 6.0), random_direction(random));
  for (Vector3& x : wall.points) x = rotation * x;
}

}  // namespace

NodalVectors Wall::coordinates() const {
  NodalVectors x(3, points.size());
  for (size_t i = 0; i < points.size(); ++i) x.col(static_cast<Eigen::Index>(i)) = points[i];
  return x;
}

std::vector<int> Wall::corners() const {
  std::vector<int> numbers;
  for (const auto& t : triangles) numbers.insert(numbers.end(), t.begin(), t.end());
  return numbers;
}

int Wall::point(const Vector3& x) {
  for (size_t i = 0; i < points.size(); ++i)
    if ((points[i] - x).norm() < 1e-9) return static_cast<int>(i);
  points.push_back(x);
  return static_cast<int>(points.size()) - 1;
}

void Wall::add_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const int i = point(a), j = point(b), k = point(c);
  triangles.push_back({i, j, k});
}

void Wall::add_quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  add_triangle(a, b, c);
  add_triangle(a, c, d);
}

void Wall::move_points(double by, std::mt19937& random) {
  for (Vector3& x : points) x += by * uniform(random, 0.0, 1.0) * random_direction(random);
}

Wall cells(const std::vector<Cell>& filled) {
  const std::set<Cell> all(filled.begin(), filled.end());
  Wall wall;
  for (const Cell& cell : all)
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end) {
        Cell beside = cell;
        beside[axis] += end == 0 ? -1 : 1;
        if (all.count(beside) > 0) continue;
        Vector3 o(cell[0], cell[1], cell[2]), u = Vector3::Zero(), v = Vector3::Zero();
        o[axis] += end;
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1.0;
        if (end == 0) std::swap(u, v);
        wall.add_quad(o, o + u, o + u + v, o + v);
      }
  return wall;
}

Wall cube() { return cells({{0, 0, 0}}); }
Wall l_profile() { return cells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}); }

Wall open_box() {
  Wall wall = cube();
  std::vector<std::array<int, 3>> kept;
  for (const auto& t : wall.triangles) {
    bool top = true;
    for (const int p : t) top = top && wall.points[p][2] == 1.0;
    if (!top) kept.push_back(t);
  }
  wall.triangles = kept;
  return wall;
}

Wall plates(const std::vector<double>& angles, int pieces) {
  Wall wall;
  for (int k = 0; k < pieces; ++k)
    for (const double a : angles) {
      const Vector3 out(std::cos(a), std::sin(a), 0.0), low(0.0, 0.0, k), high(0.0, 0.0, k + 1);
      wall.add_quad(low, low + out, high + out, high);
    }
  return wall;
}

const char* family_name(int family) {
  constexpr const char* names[kFamilies] = {"convex",           "cells",      "cells moved a little",
                                            "cells moved much", "flat field", "rough field",
                                            "plates",           "with holes"};
  return names[family];
}

Wall random_wall(std::mt19937& random, int family) {
  if (family == 7) {
    Wall wall = random_wall(random, whole(random, 0, 6));
    make_holes(wall, random);
    return wall;
  }
  Wall wall = family == 0   ? convex(random)
              : family <= 3 ? random_cells(random)
              : family == 4 ? random_field(random, 0.02)
              : family == 5 ? random_field(random, 1.0)
                            : random_plates(random);
  if (family == 2) wall.move_points(0.008, random);
  if (family == 3) wall.move_points(0.25, random);
  turn(wall, random);
  return wall;
}

Vector3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Vector3 x(normal(random), normal(random), normal(random));
  return x.normalized();
}

Vector3 random_point(std::mt19937& random, const Wall& wall, int place) {
  const auto& t = wall.triangles[whole(random, 0, static_cast<int>(wall.triangles.size()) - 1)];
  const int k = whole(random, 0, 2);
  const Vector3 &a = wall.points[t[k]], &b = wall.points[t[(k + 1) % 3]], &c = wall.points[t[(k + 2) % 3]];
  const Vector3 n = (b - a).cross(c - a).normalized(), off = random_direction(random);
  const double s = uniform(random, 0.0, 1.0), u = uniform(random, 0.0, 1.0), h = uniform(random, -0.5, 0.5);
  const Vector3 inside = a + s * (b - a) + u * (1.0 - s) * (c - a);
  switch (place) {
    case 0:
      return inside + h * off;
    case 1:
      return a + s * (b - a) + h * off;  // round an edge
    case 2:
      return a + h * off;  // round a vertex
    case 3:
      return a + s * (b - a) + h * n;  // over an edge: on a border
    case 4:
      return a + h * n;  // over a vertex
    default:
      return a + s * (b - a) + h * n + uniform(random, -1.0, 1.0) * 1e-3 * off;  // nearly over an edge
  }
}

}  // namespace brep::trials
