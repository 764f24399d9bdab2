// SPDX-License-Identifier: GPL-2.0-or-later
// From pieces whose sides are matched to edges, wedges, sheets, and corners at vertices.
#pragma once

#include <vector>

#include "brep/surface.h"

namespace brep {

/// Which sides (sides.h) meet.
struct MatchedSides {
  std::vector<int> sides;  ///< those of one edge in a row
  std::vector<int> first;  ///< where each edge begins, and their end
  std::vector<int> mate;   ///< of every side: the one beyond it inside the same plane face; else -1
};

/// Fills edges, uses, sheets, corners; sets numbers of edges in pieces and borders; splits vertices in which
/// separate fans of faces touch.  Faces, pieces, borders and vertices must be there.
void assemble(Surface& surface, const MatchedSides& matched);

/// The steps of it: edges with their wedges, sheets, corners.
void make_edges(Surface& surface, const MatchedSides& matched);
void make_sheets(Surface& surface);
void make_corners(Surface& surface, const MatchedSides& matched);

/// Where two curves of a loop of a trimmed face meet in a vertex.
struct LoopCorner {
  int face, vertex;
  int ray[2];     ///< Corner's: of the edge that leaves it, and of the one that arrives
  double turned;  ///< angle of the face there [rad]
};
/// Corners of faces without pieces.
void make_corners(Surface& surface, const std::vector<LoopCorner>& of_loops);

}  // namespace brep
