// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/tessellation.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nurbs/coincident.h"

namespace nurbs {
namespace {

// Of p from a and b's line, or from a where they are one point.
double distance_to_line(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 along = (b - a).stableNormalized();
  return (p - a - along.dot(p - a) * along).norm();
}

double distance_to_plane(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  return std::abs((b - a).cross(c - a).stableNormalized().dot(p - a));
}

// The ends of the cells of one direction.
std::vector<double> divide(const KnotVector& knots, int cells) {
  const std::vector<double>& breaks = knots.breaks();
  std::vector<double> ends{breaks.front()};
  for (std::size_t e = 1; e < breaks.size(); ++e) {
    for (int c = 1; c < cells; ++c) ends.push_back(breaks[e - 1] + (breaks[e] - breaks[e - 1]) * c / cells);
    ends.push_back(breaks[e]);
  }
  return ends;
}

// The largest distance between a patch and its triangles, in the middle of these and of their edges.
double chord_error(const Surface& patch, int cells) {
  constexpr int kParts = 6;  // of a cell, in each direction
  constexpr double kOnePoint = 1e-9;
  const std::vector<double> u = divide(patch.space.knots(0), kParts * cells),
                            v = divide(patch.space.knots(1), kParts * cells);
  const auto at = [&](std::size_t i, std::size_t j) {
    return interpolate(patch.space, patch.control_points, {u[i], v[j]});
  };
  double largest = 0.0;
  for (std::size_t j = 0; j + 1 < v.size(); j += kParts)
    for (std::size_t i = 0; i + 1 < u.size(); i += kParts) {
      const Vector3 a = at(i, j), b = at(i + kParts, j), c = at(i + kParts, j + kParts),
                    d = at(i, j + kParts);
      const auto are_apart = [least = kOnePoint * (c - a).norm()](const Vector3& p, const Vector3& q) {
        return (p - q).norm() > least;
      };
      // At a pole one triangle is left, and the diagonal one of its sides.
      const bool has_abc = are_apart(a, b) && are_apart(b, c), has_acd = are_apart(c, d) && are_apart(d, a);
      largest = std::max(
          {largest, distance_to_line(at(i + 3, j), a, b), distance_to_line(at(i + kParts, j + 3), b, c),
           distance_to_line(at(i + 3, j + kParts), c, d), distance_to_line(at(i, j + 3), d, a)});
      if (has_abc && has_acd) largest = std::max(largest, distance_to_line(at(i + 3, j + 3), a, c));
      if (has_abc) largest = std::max(largest, distance_to_plane(at(i + 4, j + 2), a, b, c));
      if (has_acd) largest = std::max(largest, distance_to_plane(at(i + 2, j + 4), a, c, d));
    }
  return largest;
}

// Grid of vertices of one patch, index first + i + n j.
struct Grid {
  int first, n, m;
};

// Each vertex' index after coincident ones of rims have become one.
std::vector<int> merge_rims(const NodalVectors& vertices, const std::vector<Grid>& grids, int& count) {
  std::vector<int> rim;
  for (const Grid& grid : grids)
    for (int a = 0; a < grid.n * grid.m; ++a)
      if (on_rim(a, grid.n, grid.m)) rim.push_back(grid.first + a);
  const std::vector<int> first = first_coincident(vertices(Eigen::all, rim));
  std::vector<int> index(vertices.cols(), -1);
  for (std::size_t r = 0; r < rim.size(); ++r) index[rim[r]] = rim[first[r]];
  count = 0;
  for (int v = 0; v < static_cast<int>(index.size()); ++v) {
    const bool merged = index[v] >= 0 && index[v] != v;
    index[v] = merged ? index[index[v]] : count++;
  }
  return index;
}

}  // namespace

int cells_within(const std::vector<Surface>& patches, double chord) {
  if (!(chord > 0.0)) throw std::invalid_argument(fmt::format("chord {}, expected a length above 0", chord));
  int cells = 1;
  for (const Surface& patch : patches)
    // The error falls with the square of the cells' size.
    for (double error = chord_error(patch, cells); error > chord; error = chord_error(patch, cells)) {
      const double wanted = std::max(cells + 1.0, std::ceil(cells * std::sqrt(error / chord)));
      if (wanted > kMostCells)
        throw std::invalid_argument(fmt::format(
            "chord {:.3g} takes about {:.3g} cells per element, expected one that takes at most {}", chord,
            wanted, kMostCells));
      cells = static_cast<int>(wanted);
    }
  return cells;
}

TriangleMesh tessellate(const std::vector<Surface>& patches, int cells) {
  if (cells < 1) throw std::invalid_argument(fmt::format("{} cells per element, expected 1 or more", cells));
  NodalVectors points(3, 0);
  std::vector<Grid> grids;
  for (const Surface& patch : patches) {
    const std::vector<double> u = divide(patch.space.knots(0), cells),
                              v = divide(patch.space.knots(1), cells);
    const Grid grid{static_cast<int>(points.cols()), static_cast<int>(u.size()), static_cast<int>(v.size())};
    points.conservativeResize(3, grid.first + grid.n * grid.m);
    for (int a = 0; a < grid.n * grid.m; ++a)
      points.col(grid.first + a) =
          interpolate(patch.space, patch.control_points, {u[a % grid.n], v[a / grid.n]});
    grids.push_back(grid);
  }
  int count = 0;
  const std::vector<int> index = merge_rims(points, grids, count);

  TriangleMesh mesh{NodalVectors(3, count), {}};
  for (int v = 0; v < points.cols(); ++v) mesh.vertices.col(index[v]) = points.col(v);
  const auto add = [&](int a, int b, int c) {
    if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
  };
  for (const Grid& grid : grids)
    for (int j = 0; j + 1 < grid.m; ++j)
      for (int i = 0; i + 1 < grid.n; ++i) {
        const int* corner = &index[grid.first + i + grid.n * j];
        add(corner[0], corner[1], corner[grid.n + 1]);
        add(corner[0], corner[grid.n + 1], corner[grid.n]);
      }
  return mesh;
}

}  // namespace nurbs
