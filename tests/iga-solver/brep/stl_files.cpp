// SPDX-License-Identifier: GPL-2.0-or-later
#include "stl_files.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry_io/stl_cube.h"

namespace brep::trials {
namespace {

using geometry_io::Corner;
using geometry_io::Facet;

bool has_side(const std::array<int, 3>& corners, int a, int b) {
  return std::count(corners.begin(), corners.end(), a) + std::count(corners.begin(), corners.end(), b) == 2;
}

// Whether a side is between two triangles in one plane.
bool inside_a_plane(const Wall& wall, int a, int b) {
  std::vector<Vector3> normals;
  for (const auto& t : wall.triangles)
    if (has_side(t, a, b))
      normals.push_back(
          (wall.points[t[1]] - wall.points[t[0]]).cross(wall.points[t[2]] - wall.points[t[0]]).normalized());
  return normals.size() == 2 && normals[0].cross(normals[1]).norm() < 1e-9;
}

double least_height(const Wall& wall, const std::array<int, 3>& t) {
  const Vector3 &a = wall.points[t[0]], &b = wall.points[t[1]], &c = wall.points[t[2]];
  return (b - a).cross(c - a).norm() / std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

// Thin ones are not cut again: the judge, too, must tell what is in one plane.
bool beside_thin_ones(const Wall& wall, int a, int b) {
  return std::any_of(wall.triangles.begin(), wall.triangles.end(),
                     [&](const auto& t) { return has_side(t, a, b) && least_height(wall, t) < 1e-2; });
}

// A point on a side, for all triangles that have the side.
void split_side(Wall& wall, int triangle, int side, double where) {
  const int a = wall.triangles[triangle][side], b = wall.triangles[triangle][(side + 1) % 3];
  const int middle = static_cast<int>(wall.points.size());
  wall.points.push_back(wall.points[a] + where * (wall.points[b] - wall.points[a]));
  const size_t count = wall.triangles.size();
  for (size_t t = 0; t < count; ++t) {
    if (!has_side(wall.triangles[t], a, b)) continue;
    auto half = wall.triangles[t];
    std::replace(half.begin(), half.end(), a, middle);
    std::replace(wall.triangles[t].begin(), wall.triangles[t].end(), b, middle);
    wall.triangles.push_back(half);
  }
}

// A point inside, at this part of the height over a side.
void split_inside(Wall& wall, int triangle, int side, double where, double height) {
  auto& corners = wall.triangles[triangle];
  const int a = corners[side], b = corners[(side + 1) % 3], c = corners[(side + 2) % 3];
  const Vector3 foot = wall.points[a] + where * (wall.points[b] - wall.points[a]);
  const int inside = static_cast<int>(wall.points.size());
  wall.points.push_back(foot + height * (wall.points[c] - foot));
  corners = {a, b, inside};
  wall.triangles.push_back({b, c, inside});
  wall.triangles.push_back({c, a, inside});
}

Corner rounded(const Vector3& x, bool differ, std::mt19937& random) {
  Corner corner;
  for (int i = 0; i < 3; ++i) {
    corner[i] = static_cast<float>(x[i]);
    const int way = differ ? whole(random, -1, 1) : 0;
    if (way != 0) corner[i] = std::nextafter(corner[i], way > 0 ? 1e9F : -1e9F);
  }
  return corner;
}

// What a reader leaves out.
void add_waste(std::vector<Facet>& facets, std::mt19937& random) {
  const Facet any = facets[random() % facets.size()], other = facets[random() % facets.size()];
  facets.push_back({any[1], any[0], any[2]});
  facets.push_back({other[0], other[1], other[0]});
}

std::string ascii(const std::vector<Facet>& facets, int digits, std::mt19937& random) {
  const size_t solids = std::min<size_t>(facets.size(), 1 + random() % 3);
  std::string text;
  for (size_t s = 0; s < solids; ++s) {
    text += fmt::format("solid part {}\n", s);
    for (size_t f = s * facets.size() / solids; f < (s + 1) * facets.size() / solids; ++f) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const Corner& x : facets[f])
        text += fmt::format("vertex {0:.{3}e} {1:.{3}e} {2:.{3}e}\n", x[0], x[1], x[2], digits - 1);
      text += "endloop\nendfacet\n";
    }
    text += fmt::format("endsolid part {}\n", s);
  }
  return text;
}

}  // namespace

void cut_finely(Wall& wall, std::mt19937& random) {
  const int cuts = whole(random, 0, 6);
  for (int k = 0; k < cuts; ++k) {
    const int t = whole(random, 0, static_cast<int>(wall.triangles.size()) - 1), side = whole(random, 0, 2);
    const double where = uniform(random, 0.2, 0.8), small = std::pow(10.0, uniform(random, -6.5, -0.5));
    const int a = wall.triangles[t][side], b = wall.triangles[t][(side + 1) % 3];
    if (beside_thin_ones(wall, a, b)) continue;
    const bool inside = inside_a_plane(wall, a, b);
    // A strip along a kink is part of the wrong plane if it is within 1e-6 of the size of that.
    const double height = inside || small < 1e-6 ? small : std::max(small, 1e-3);
    // Shorter edges are bent by rounding, and feet on them move.
    const double shortest = (inside ? 1e-3 : 5e-2) / (wall.points[b] - wall.points[a]).norm();
    if (whole(random, 0, 1) == 1)
      split_inside(wall, t, side, where, height);
    else if (shortest < 0.5)
      split_side(wall, t, side, std::max(small, shortest));
  }
}

std::string stl_file(const Wall& wall, std::mt19937& random) {
  const int kind = whole(random, 0, 2);  // 7 or 9 digits, binary
  std::vector<Facet> facets;
  for (auto corners : wall.triangles) {
    if (random() % 4 == 0) std::swap(corners[0], corners[1]);
    std::rotate(corners.begin(), corners.begin() + random() % 3, corners.end());
    Facet facet;
    for (int i = 0; i < 3; ++i) facet[i] = rounded(wall.points[corners[i]], kind > 0, random);
    facets.push_back(facet);
  }
  if (random() % 2 == 0) add_waste(facets, random);
  std::shuffle(facets.begin(), facets.end(), random);
  return kind == 2 ? geometry_io::binary_stl(facets, "solid of a trial")
                   : ascii(facets, 7 + 2 * kind, random);
}

}  // namespace brep::trials
