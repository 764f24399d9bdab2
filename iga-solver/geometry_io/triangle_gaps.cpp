// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "brep/side_matching.h"
#include "brep/sides.h"
#include "brep/t_junctions.h"
#include "geometry_io/triangle_mesh.h"

namespace geometry_io {
namespace {

struct FreeEdge {
  int from, to;  // points
  int triangle;
};

// Triangles that are cut at T-junctions, as those of a wall are.
class JoinedTriangles {
 public:
  explicit JoinedTriangles(const TriangleMesh& mesh)
      : points_(mesh.points), size_((points_.rowwise().maxCoeff() - points_.rowwise().minCoeff()).norm()) {
    for (int t = 0; t < mesh.count(); ++t)
      cut_.corners.push_back({mesh.triangles[3 * t], mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]});
    matched_ = brep::match(points_.cols(), cut_.corners);
    cut_ = brep::cut_at_t_junctions(points_, cut_.corners, matched_, brep::kOnSide * size_);
    if (cut_.junctions > 0) matched_ = brep::match(points_.cols(), cut_.corners);
  }

  std::vector<FreeEdge> free_edges() const {
    std::vector<FreeEdge> found;
    for (std::size_t e = 0; e + 1 < matched_.first.size(); ++e) {
      if (matched_.first[e + 1] - matched_.first[e] != 1) continue;
      const int side = matched_.sides[matched_.first[e]], t = brep::piece_of_side(side);
      if (!is_nothing(t)) found.push_back({corner(t, side % 4), corner(t, side % 4 + 1), cut_.number[t]});
    }
    return found;
  }

 private:
  int corner(int t, int i) const { return cut_.corners[t][i % 3]; }
  nurbs::Vector3 way(int t, int i) const { return points_.col(corner(t, i + 1)) - points_.col(corner(t, i)); }

  // A triangle without width is part of the one beyond its longest side, and nothing without it.
  bool is_nothing(int t) const {
    double length[3];
    for (int i = 0; i < 3; ++i) length[i] = way(t, i).norm();
    const auto longest = static_cast<int>(std::max_element(length, length + 3) - length);
    return way(t, 0).cross(way(t, 1)).norm() < kSamePoint * size_ * length[longest] &&
           matched_.mate[brep::side_number(t, longest)] < 0;
  }

  const nurbs::NodalVectors& points_;
  double size_;  // [length]
  brep::CutTriangles cut_;
  brep::MatchedSides matched_;
};

// The point that stands for all that hang together with this one.
int root_of(std::vector<int>& parent, int point) {
  while (parent[point] != point) point = parent[point] = parent[parent[point]];
  return point;
}

}  // namespace

std::vector<Gap> gaps_of(const TriangleMesh& mesh) {
  const std::vector<FreeEdge> free = JoinedTriangles(mesh).free_edges();
  std::vector<int> parent(mesh.points.cols());
  std::iota(parent.begin(), parent.end(), 0);
  for (const FreeEdge& edge : free) parent[root_of(parent, edge.to)] = root_of(parent, edge.from);
  std::map<int, Gap> by_root;
  for (const FreeEdge& edge : free) {
    Gap& gap = by_root[root_of(parent, edge.from)];
    if (gap.edges++ == 0 || edge.triangle < gap.triangle) gap.triangle = edge.triangle;
    gap.length += (mesh.points.col(edge.from) - mesh.points.col(edge.to)).norm();
  }
  std::vector<Gap> gaps;
  for (const auto& entry : by_root) gaps.push_back(entry.second);
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.length > b.length; });
  return gaps;
}

}  // namespace geometry_io
