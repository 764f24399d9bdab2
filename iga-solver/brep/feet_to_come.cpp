// SPDX-License-Identifier: GPL-2.0-or-later
// Which pieces of a trimmed wall can have a foot of a point that moves a little.
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
