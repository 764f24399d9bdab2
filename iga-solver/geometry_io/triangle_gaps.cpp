// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "geometry_io/triangle_mesh.h"

namespace geometry_io {
namespace {

struct HalfEdge {
  int low, high;  // points
  int triangle;
};

bool same_edge(const HalfEdge& a, const HalfEdge& b) { return a.low == b.low && a.high == b.high; }

// Those that one triangle has, ordered by their points.
std::vector<HalfEdge> free_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> all;
  all.reserve(mesh.triangles.size());
  for (int t = 0; t < mesh.count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[3 * t + k], mesh.triangles[3 * t + (k + 1) % 3]);
      all.push_back({low, high, t});
    }
  std::sort(all.begin(), all.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::vector<HalfEdge> free;
  for (std::size_t e = 0; e < all.size(); ++e)
    if (!(e > 0 && same_edge(all[e], all[e - 1])) && !(e + 1 < all.size() && same_edge(all[e], all[e + 1])))
      free.push_back(all[e]);
  return free;
}

// The point that stands for all that hang together with this one.
int root_of(std::vector<int>& parent, int point) {
  while (parent[point] != point) point = parent[point] = parent[parent[point]];
  return point;
}

}  // namespace

std::vector<Gap> gaps_of(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> free = free_edges(mesh);
  std::vector<int> parent(mesh.points.cols());
  std::iota(parent.begin(), parent.end(), 0);
  for (const HalfEdge& edge : free) parent[root_of(parent, edge.high)] = root_of(parent, edge.low);
  std::map<int, Gap> by_root;
  for (const HalfEdge& edge : free) {
    Gap& gap = by_root[root_of(parent, edge.low)];
    if (gap.edges++ == 0) gap.triangle = edge.triangle;
    gap.length += (mesh.points.col(edge.low) - mesh.points.col(edge.high)).norm();
  }
  std::vector<Gap> gaps;
  for (const auto& entry : by_root) gaps.push_back(entry.second);
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.length > b.length; });
  return gaps;
}

}  // namespace geometry_io
