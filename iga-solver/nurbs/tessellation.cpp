// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/tessellation.h"

#include <fmt/format.h>

#include <stdexcept>

#include "nurbs/coincident.h"

namespace nurbs {
namespace {

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
