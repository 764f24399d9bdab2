// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "brep/assembly.h"
#include "brep/disjoint_sets.h"
#include "brep/sides.h"

namespace brep {
namespace {

constexpr double kFlat = 1e-9;  // [rad]

int& use_of_side(Surface& surface, int side) {
  Piece& piece = surface.pieces[piece_of_side(side)];
  return piece.triangle() ? piece.edge[side % 4] : surface.borders[piece.edge[0]].use[side % 4];
}

void end_vertices(const Surface& surface, int side, int* vertex) {
  const Piece& piece = surface.pieces[piece_of_side(side)];
  const int i = side % 4;
  for (int k = 0; k < 2; ++k)
    vertex[k] =
        piece.triangle() ? piece.vertex[(i + k) % 3] : surface.borders[piece.edge[0]].vertex[(i + k) % 4];
  if (!piece.triangle() && surface.faces[piece.face].whole_turn(i % 2)) vertex[0] = vertex[1] = -1;
}

// A face that meets in an edge, with its angle round it.
struct Meeting {
  EdgeUse use;
  int piece_side;
  double angle;
};

Meeting meeting(const Surface& surface, const Edge& edge, int number, int piece_side) {
  const Side side = side_at(surface, piece_side);
  Vector3 u = edge.radial, v = edge.axis;
  if (edge.line())
    v = edge.axis.cross(edge.radial);
  else
    u = ((side.at - edge.origin) - (side.at - edge.origin).dot(edge.axis) * edge.axis).normalized();
  Meeting meeting{};
  double* m = meeting.use.conormal;
  m[0] = side.conormal.dot(u), m[1] = side.conormal.dot(v);
  const double length = std::hypot(m[0], m[1]);
  m[0] /= length, m[1] /= length;
  meeting.use.face = surface.pieces[piece_of_side(piece_side)].face;
  meeting.use.edge = number;
  meeting.use.side = side.normal.dot(m[0] * v - m[1] * u) > 0.0 ? 1 : -1;
  meeting.piece_side = piece_side;
  meeting.angle = std::atan2(m[1], m[0]);
  if (meeting.angle < 0.0) meeting.angle += 2.0 * nurbs::kPi;
  return meeting;
}

Wedge wedge_of(double angle, double edge_angle) {
  if (angle > nurbs::kPi + edge_angle) return Wedge::convex;
  if (angle < nurbs::kPi - edge_angle) return Wedge::concave;
  return angle < nurbs::kPi - kFlat ? Wedge::smooth_concave : Wedge::smooth;
}

void make_sheets(Surface& surface) {
  DisjointSets sets(2 * static_cast<int>(surface.faces.size()));
  for (const Edge& edge : surface.edges)
    for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
      const EdgeUse &use = surface.uses[u], &next = surface.next_use(edge, u);
      if (joins(use.wedge)) sets.join(2 * use.face + (use.side < 0), 2 * next.face + (next.side > 0));
    }
  surface.sheet_count = sets.number(surface.sheets);
}

}  // namespace

void make_edges(Surface& surface, const MatchedSides& matched) {
  const int count = static_cast<int>(matched.first.size()) - 1;
  surface.edges.reserve(count);
  surface.uses.reserve(matched.sides.size());
  std::vector<Meeting> met;
  for (int e = 0; e < count; ++e) {
    const int *begin = matched.sides.data() + matched.first[e],
              *end = matched.sides.data() + matched.first[e + 1];
    Edge edge = curve_of(surface, *begin);
    end_vertices(surface, *begin, edge.vertex);
    if (edge.line()) edge.radial = side_at(surface, *begin).conormal;
    edge.first_use = static_cast<int>(surface.uses.size());
    edge.use_count = static_cast<int>(end - begin);
    met.clear();
    for (const int* side = begin; side != end; ++side) met.push_back(meeting(surface, edge, e, *side));
    std::stable_sort(met.begin(), met.end(),
                     [](const Meeting& a, const Meeting& b) { return a.angle < b.angle; });
    for (size_t k = 0; k < met.size(); ++k) {
      const double next = k + 1 < met.size() ? met[k + 1].angle : met[0].angle + 2.0 * nurbs::kPi;
      met[k].use.wedge = wedge_of(next - met[k].angle, surface.edge_angle);
      met[k].use.wide = next - met[k].angle >= nurbs::kPi;
      use_of_side(surface, met[k].piece_side) = static_cast<int>(surface.uses.size());
      surface.uses.push_back(met[k].use);
    }
    surface.edges.push_back(edge);
  }
  make_sheets(surface);
}

void assemble(Surface& surface, const MatchedSides& matched) {
  make_edges(surface, matched);
  make_corners(surface, matched);
}

}  // namespace brep
