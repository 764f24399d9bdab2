// SPDX-License-Identifier: GPL-2.0-or-later
// Which pieces of a trimmed wall can have a foot of a point that moves a little.
#include <algorithm>
#include <cmath>

#include "brep/edge_foot.h"
#include "brep/foot_search.h"

namespace brep {

// While the foot on the surface that a face is cut from does not jump, it comes into the face over its border
// alone, where the point is not farther from that than from the surface.
bool FootSearch::may_have_foot(const Piece& piece, const Vector3& d, double reach, double margin,
                               bool near_border) const {
  const Face& face = surface_.faces[piece.face];
  if (piece.kind == Piece::Kind::element)
    return surface_.patches->may_have_foot(face.patch, piece.element(), d, reach, face.outward, margin);
  if (piece.kind != Piece::Kind::trimmed) return true;
  const Projection at = face.project(d);
  if (face.outward * at.height < -margin) return false;  // d is behind it, and stays there
  return near_border || !(face.distance_of_focus(d) > margin) || surface_.domains[piece.face].inside(at.xi);
}

bool FootSearch::is_border(const Piece& piece, int face) const {
  if (piece.kind == Piece::Kind::edge) {
    const Edge& edge = surface_.edges[piece.edge[0]];
    const EdgeUse* const first = surface_.uses.data() + edge.first_use;
    return std::any_of(first, first + edge.use_count, [&](const EdgeUse& use) { return use.face == face; });
  }
  if (piece.kind != Piece::Kind::vertex) return false;
  const Vertex& vertex = surface_.vertices[piece.vertex[0]];
  const Corner* const first = surface_.corners.data() + vertex.first_corner;
  return std::any_of(first, first + vertex.corner_count,
                     [&](const Corner& corner) { return corner.face == face; });
}

// A foot comes over an edge into a face, or leaves it, where the point is square above the edge; so does the
// foot of the edge begin and end.  How far it is from there changes no faster than it moves, where faces
// stand alike all along.
double FootSearch::room_beside_edge(const Piece& piece, const Vector3& d, double reach) const {
  constexpr double kAsAbove = 1000.0;  // slacks within which Minima looks twice
  const Edge& edge = surface_.edges[piece.edge[0]];
  if (edge.spline() || edge.varies || (!edge.line() && edge.R <= 2.0 * reach)) return 0.0;
  const EdgeFoot foot(edge, d);
  double room = reach;
  for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
    const double* const m = surface_.uses[u].conormal;
    room = std::min(room, std::abs(foot.q[0] * m[0] + foot.q[1] * m[1]));
  }
  return room - kAsAbove * surface_.slack_of_edge(piece.edge[0]);
}

double FootSearch::room_on_trimmed(const Vector3& d, double reach, const int* pieces, int count,
                                   const std::vector<Foot>& feet, int* below) const {
  double room = reach;
  size_t found = 0;
  for (const int* number = pieces; number < pieces + count && room > 0.0; ++number) {
    const Piece& piece = surface_.pieces[*number];
    if (piece.kind == Piece::Kind::edge) room = std::min(room, room_beside_edge(piece, d, reach));
    if (piece.kind == Piece::Kind::edge) continue;
    if (piece.kind != Piece::Kind::trimmed) return 0.0;
    const Face& face = surface_.faces[piece.face];
    const Projection at = face.project(d);
    room = std::min(room, face.distance_of_focus(d));
    if (std::abs(at.height) >= reach) continue;
    if (face.outward * at.height < 0.0) room = std::min(room, std::abs(at.height));
    if (face.outward * at.height < 0.0 || !surface_.domains[piece.face].inside(at.xi)) continue;
    const auto foot = std::find_if(feet.begin(), feet.end(), [&](const Foot& f) {
      return f.patch == piece.face && f.status == FootStatus::interior;
    });
    if (foot == feet.end()) return 0.0;  // one that gives way to another
    below[foot - feet.begin()] = *number;
    ++found;
  }
  return found == feet.size() ? room - 2.0 * border_slack_ : 0.0;
}

int FootSearch::activate_with_feet(const Vector3& d, double reach, double margin, const int* pieces,
                                   int count, int* active) const {
  const int near = activate(d, reach + 2.0 * border_slack_, pieces, count, active);
  if (!surface_.trimmed()) return near;
  const auto near_border = [&](int face) {
    return std::any_of(active, active + near,
                       [&](int number) { return is_border(surface_.pieces[number], face); });
  };
  int kept = 0;  // borders come behind faces, and none is left out
  for (int k = 0; k < near; ++k) {
    const Piece& piece = surface_.pieces[active[k]];
    if (may_have_foot(piece, d, reach, margin, piece.kind == Piece::Kind::trimmed && near_border(piece.face)))
      active[kept++] = active[k];
  }
  return kept;
}

}  // namespace brep
