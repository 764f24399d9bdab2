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
                               const std::vector<Border>& borders) const {
  const Face& face = surface_.faces[piece.face];
  if (piece.kind == Piece::Kind::element)
    return surface_.patches->may_have_foot(face.patch, piece.element(), d, reach, face.outward, margin);
  if (piece.kind != Piece::Kind::trimmed) return true;
  const Projection at = face.project(d);
  if (face.outward * at.height < -margin) return false;  // d is behind it, and stays there
  const bool near_border = std::any_of(borders.begin(), borders.end(), [&](const Border& border) {
    return may_come_over(border, piece.face);
  });
  return near_border || !(face.distance_of_focus(d) > margin) || surface_.domains[piece.face].inside(at.xi);
}

// Whether the foot over a face may come over this piece, into the face or out of it.
bool FootSearch::may_come_over(const Border& border, int face) const {
  const Piece& piece = surface_.pieces[border.piece];
  if (piece.kind == Piece::Kind::edge) {
    const Edge& edge = surface_.edges[piece.edge[0]];
    for (int u = 0; u < edge.use_count; ++u)
      if (surface_.uses[edge.first_use + u].face == face &&
          (edge.use_count != 2 || !border.sides.is_certain(u)))
        return true;
    return false;
  }
  const Vertex& vertex = surface_.vertices[piece.vertex[0]];
  const Corner* const first = surface_.corners.data() + vertex.first_corner;
  return std::any_of(first, first + vertex.corner_count,
                     [&](const Corner& corner) { return corner.face == face; });
}

int FootSearch::activate_with_feet(const Vector3& d, double reach, double margin, const int* pieces,
                                   int count, int* active) const {
  const int near = activate(d, reach + 2.0 * border_slack_, pieces, count, active);
  if (!surface_.trimmed()) return near;
  thread_local std::vector<Border> borders;
  borders.clear();
  for (int k = 0; k < near; ++k) {
    const Piece& piece = surface_.pieces[active[k]];
    if (piece.kind == Piece::Kind::edge)
      borders.push_back({active[k], edge_sides_.sides(piece, d, reach, margin)});
    if (piece.kind == Piece::Kind::vertex) borders.push_back({active[k], {}});
  }
  int kept = 0;
  auto border = borders.cbegin();
  for (int k = 0; k < near; ++k) {
    const Piece& piece = surface_.pieces[active[k]];
    const bool is_border = border != borders.cend() && border->piece == active[k];
    if (is_border ? !(border++)->sides.has_no_contact() : may_have_foot(piece, d, reach, margin, borders))
      active[kept++] = active[k];
  }
  return without_patches(d, reach, active, kept, borders);
}

// Less the elements of patches that have no foot and to which none can come over their borders.
int FootSearch::without_patches(const Vector3& d, double reach, int* pieces, int count,
                                const std::vector<Border>& borders) const {
  int kept = 0;
  for (int k = 0; k < count;) {
    const Piece& piece = surface_.pieces[pieces[k]];
    int end = k + 1;
    if (piece.kind == Piece::Kind::element) {
      while (end < count && surface_.pieces[pieces[end]].kind == Piece::Kind::element &&
             surface_.pieces[pieces[end]].face == piece.face)
        ++end;
      const bool stays = std::none_of(borders.begin(), borders.end(), [&](const Border& border) {
        return may_come_over(border, piece.face);
      });
      if (stays && has_no_foot_to_come(pieces + k, end - k, d, reach)) k = end;
    }
    for (; k < end; ++k) pieces[kept++] = pieces[k];
  }
  return kept;
}

// Where a patch is not curved much, feet do not begin inside of it; on either side, as d may pass through.
bool FootSearch::has_no_foot_to_come(const int* elements, int count, const Vector3& d, double reach) const {
  if (!is_calm_patch(elements, count, d, reach)) return false;
  thread_local std::vector<search::Foot> found;
  const int face = surface_.pieces[*elements].face, patch = surface_.faces[face].patch;
  surface_.patches->minima_on(patch, elements_of_patch(elements, count), d, reach, found);
  return std::none_of(found.begin(), found.end(), [&](const search::Foot& foot) {
    return !surface_.patches->on_border(patch, foot.xi) && surface_.domains[face].inside(foot.xi);
  });
}

// Of a trimmed face edges and vertices would be among the pieces.  Where it is not curved much feet do not
// begin, but it may be near twice: on both sides of d, as a channel or a scroll is.
bool FootSearch::is_well_inside_patch(const int* pieces, int count, const Vector3& d, double reach) const {
  if (!is_calm_patch(pieces, count, d, reach)) return false;
  thread_local std::vector<search::Foot> found;
  const int patch = surface_.faces[surface_.pieces[*pieces].face].patch;
  const std::vector<int>& elements = elements_of_patch(pieces, count);
  if (surface_.patches->share_one_foot(patch, elements)) return true;
  surface_.patches->minima_on(patch, elements, d, reach, found);
  return found.size() <= 1;
}

// Whether these are elements of one patch, each of which has one foot at most, however d moves within reach.
bool FootSearch::is_calm_patch(const int* pieces, int count, const Vector3& d, double reach) const {
  const Piece& first = surface_.pieces[*pieces];
  const int patch = surface_.faces[first.face].patch;
  return std::all_of(pieces, pieces + count, [&](int number) {
    const Piece& piece = surface_.pieces[number];
    return piece.kind == Piece::Kind::element && piece.face == first.face &&
           surface_.patches->has_one_foot(patch, piece.element(), d, reach);
  });
}

const std::vector<int>& FootSearch::elements_of_patch(const int* pieces, int count) const {
  thread_local std::vector<int> elements;
  elements.clear();
  for (int k = 0; k < count; ++k) elements.push_back(surface_.pieces[pieces[k]].element());
  return elements;
}

}  // namespace brep
