// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles on trimmed faces, for who draws, writes or counts on them.
#pragma once

#include <vector>

#include "brep/triangle_mesh.h"
#include "nurbs/tessellation.h"

namespace brep {

constexpr double kFacetChord = 1e-3;  ///< of the wall's size, where nobody says otherwise

struct Facets {
  nurbs::TriangleMesh mesh;  ///< corners on the faces; seen counterclockwise from side +, or from outside
  std::vector<int> face;     ///< of each triangle
};

/// Of a wall of trimmed faces, within `chord` of it [length].  Where rows of triangles meet, corners of one
/// lie on sides of the other, and so do those of two faces: gaps are not wider than the chord either.  Throws
/// std::invalid_argument unless chord > 0.
Facets facets_of(const Surface& surface, double chord);

/// The triangles of any wall of faces: its own, or those within `chord` of it.
nurbs::TriangleMesh triangles_of(const Surface& surface, double chord);

}  // namespace brep
