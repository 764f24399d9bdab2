// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/summary.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "brep/disjoint_sets.h"

namespace brep {
namespace {

constexpr double kSmooth = 1e-3;  // [rad]

// Of a wall of triangles: six times the volume between each face and the centre of the box around the wall,
// positive if the face looks away from it, and twice its area.
struct Measures {
  std::vector<double> volume, area;

  explicit Measures(const Surface& surface) : volume(surface.faces.size()), area(surface.faces.size()) {
    const Vector3 centre = 0.5 * (surface.low + surface.high);
    for (const Piece& piece : surface.pieces) {
      if (!piece.triangle())
        throw std::invalid_argument("the summary of a wall: a face is round, expected triangles");
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = surface.vertices[piece.vertex[k]].point - centre;
      volume[piece.face] += corners.determinant();
      area[piece.face] += (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
    }
  }
};

// The angle between two faces that meet at an edge, less pi, without its sign [rad].
double turn(const EdgeUse& a, const EdgeUse& b) {
  const double cross = a.conormal[0] * b.conormal[1] - a.conormal[1] * b.conormal[0];
  const double dot = a.conormal[0] * b.conormal[0] + a.conormal[1] * b.conormal[1];
  return std::atan2(std::abs(cross), -dot);
}

void count_edge(const Surface& surface, const Edge& edge, Summary& summary) {
  const EdgeUse* use = &surface.uses[edge.first_use];
  if (edge.use_count == 1) {
    ++summary.free;
    summary.free_length += edge.line() ? edge.length : edge.R * edge.length;
    return;
  }
  if (edge.use_count > 2) {
    ++summary.many;
    return;
  }
  const Wedge before_normal = use[0].side > 0 ? use[0].wedge : use[1].wedge;
  if (before_normal == Wedge::convex)
    ++summary.convex;
  else if (before_normal == Wedge::concave)
    ++summary.concave;
  else
    ++(turn(use[0], use[1]) < kSmooth ? summary.smooth : summary.near_smooth);
}

// Where all faces are turned alike: what their normals say, cavities included.  Else the regions that the
// wall cuts off from the rest of space, each once.
double enclosed(const Surface& surface, const std::vector<double>& volume) {
  const int sides = 2 * static_cast<int>(surface.faces.size());
  DisjointSets regions(sides);
  const auto side_number = [](int face, int side) { return 2 * face + (side < 0); };
  bool alike = true;
  for (const Edge& edge : surface.edges)
    for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
      const EdgeUse &begin = surface.uses[u], &end = surface.next_use(edge, u);
      regions.join(side_number(begin.face, begin.side), side_number(end.face, -end.side));
      alike &= begin.side == -end.side;
    }
  std::vector<double> of_region(sides, 0.0);
  double sum = 0.0, cut_off = 0.0;
  for (int face = 0; 2 * face < sides; ++face) {
    sum += volume[face];
    of_region[regions.find(2 * face)] += volume[face];
    of_region[regions.find(2 * face + 1)] -= volume[face];
  }
  for (const double one : of_region) cut_off += std::max(-one, 0.0);
  return (alike ? std::abs(sum) : cut_off) / 6.0;
}

}  // namespace

Summary summary_of(const Surface& surface) {
  Summary summary;
  const Measures measures(surface);
  for (const Face& face : surface.faces) ++summary.faces[static_cast<int>(face.kind)];
  for (const double twice : measures.area) summary.area += 0.5 * twice;
  summary.pieces = static_cast<int>(surface.pieces.size());
  summary.vertices = static_cast<int>(surface.vertices.size());
  summary.sheets = surface.sheet_count;
  for (const Edge& edge : surface.edges) count_edge(surface, edge, summary);
  summary.closed = summary.free == 0;
  if (summary.closed) summary.volume = enclosed(surface, measures.volume);
  return summary;
}

}  // namespace brep
