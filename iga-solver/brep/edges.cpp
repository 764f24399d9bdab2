// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "brep/assembly.h"
#include "brep/disjoint_sets.h"
#include "brep/edge_uses.h"
#include "brep/sides.h"

namespace brep {
namespace {

int& use_of_side(Surface& surface, int side) {
  Piece& piece = surface.pieces[piece_of_side(side)];
  return piece.triangle() ? piece.edge[side % 4] : surface.borders[piece.borders()].use[side % 4];
}

void end_vertices(const Surface& surface, int side, int* vertex) {
  const Piece& piece = surface.pieces[piece_of_side(side)];
  const int i = side % 4;
  for (int k = 0; k < 2; ++k)
    vertex[k] =
        piece.triangle() ? piece.vertex[(i + k) % 3] : surface.borders[piece.borders()].vertex[(i + k) % 4];
  if (!piece.triangle() && surface.faces[piece.face].whole_turn(i % 2)) vertex[0] = vertex[1] = -1;
}

struct SideMeeting : Meeting {
  int piece_side;
  SideMeeting(const Meeting& meeting, int side) : Meeting(meeting), piece_side(side) {}
};

}  // namespace

void make_sheets(Surface& surface) {
  DisjointSets sets(2 * static_cast<int>(surface.faces.size()));
  for (const Edge& edge : surface.edges)
    for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
      const EdgeUse &use = surface.uses[u], &next = surface.next_use(edge, u);
      if (joins(use.wedge)) sets.join(2 * use.face + (use.side < 0), 2 * next.face + (next.side > 0));
    }
  surface.sheet_count = sets.number(surface.sheets);
}

void make_edges(Surface& surface, const MatchedSides& matched) {
  const int count = static_cast<int>(matched.first.size()) - 1;
  surface.edges.reserve(count);
  surface.uses.reserve(matched.sides.size());
  std::vector<SideMeeting> met;
  for (int e = 0; e < count; ++e) {
    const int *begin = matched.sides.data() + matched.first[e],
              *end = matched.sides.data() + matched.first[e + 1];
    Edge edge = curve_of(surface, *begin);
    end_vertices(surface, *begin, edge.vertex);
    if (edge.line()) edge.radial = side_at(surface, *begin).conormal;
    edge.first_use = static_cast<int>(surface.uses.size());
    edge.use_count = static_cast<int>(end - begin);
    met.clear();
    for (const int* side = begin; side != end; ++side) {
      const Side at = side_at(surface, *side);
      met.emplace_back(meeting(at, across(edge, at.at), surface.pieces[piece_of_side(*side)].face, e), *side);
    }
    sort_round(met, surface.edge_angle);
    for (const SideMeeting& meeting : met) {
      use_of_side(surface, meeting.piece_side) = static_cast<int>(surface.uses.size());
      surface.uses.push_back(meeting.use);
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
