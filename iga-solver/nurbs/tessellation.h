// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles with their corners on the surface.
#pragma once

#include <array>
#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

struct TriangleMesh {
  NodalVectors vertices;                      ///< 3 x n [length], each on a patch
  std::vector<std::array<int, 3>> triangles;  ///< vertices, in the sense of dS/dxi x dS/deta
};

/// cells x cells cells per element, two triangles each.  Vertices that coincide on the rims of patches are
/// one: poles (their degenerate triangles are left out), seams, borders between patches with the same
/// division.  Throws std::invalid_argument unless cells >= 1.
TriangleMesh tessellate(const std::vector<Surface>& patches, int cells);

/// How many cells per element keep the triangles within `chord` of the surface [length], as measured in the
/// middle of each triangle and of its edges; hardly more than it takes.  Throws std::invalid_argument unless
/// chord > 0, or if it takes more than kMostCells.
constexpr int kMostCells = 1000;
int cells_within(const std::vector<Surface>& patches, double chord);

}  // namespace nurbs
