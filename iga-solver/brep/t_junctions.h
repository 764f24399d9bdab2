// SPDX-License-Identifier: GPL-2.0-or-later
// Where corners of triangles lie on the sides of others: STL files of welded or cut bodies have such places.
#pragma once

#include <array>
#include <vector>

#include "brep/assembly.h"
#include "brep/names.h"

namespace brep {

/// Of the size of all triangles: how far a corner may be off a side that it lies on.  In files of six digits
/// corners and sides are rounded each for itself.
constexpr double kOnSide = 1e-5;

struct CutTriangles {
  std::vector<std::array<int, 3>> corners;
  std::vector<int> number;  ///< of each: the triangle that it is part of
  int junctions = 0;        ///< corners on sides
};
/// Triangles cut where corners of others lie on their sides, within `tolerance` [length]: sides that met in
/// part meet from end to end.  Looked for are corners of sides that one triangle alone has, so a closed mesh
/// stays as it is; `matched` are the sides (side_matching.h).
CutTriangles cut_at_t_junctions(const NodalVectors& points, const std::vector<std::array<int, 3>>& triangles,
                                const MatchedSides& matched, double tolerance);

}  // namespace brep
