// SPDX-License-Identifier: GPL-2.0-or-later
// What changes the edges and vertices of a CAD model: cuts, vertices that become one, what is no longer used.
#pragma once

#include <vector>

#include "brep/cad_model.h"
#include "brep/disjoint_sets.h"

namespace geometry_io {

/// Where a trim is.
struct TrimPlace {
  int face, loop, trim;
};
/// The trims of every edge.
std::vector<std::vector<TrimPlace>> uses_of_edges(const brep::CadModel& model);
const brep::Trim& trim_at(const brep::CadModel& model, const TrimPlace& place);

/// A vertex inside an edge, at a parameter of its curve (EdgeCurve).
struct Cut {
  double t;
  int vertex;
};
/// Cuts edges and the borders along them; `cuts` of every edge, rising.  Returns the numbers of the parts of
/// every edge in its sense: one that is cut becomes the first of them.
std::vector<std::vector<int>> cut_edges(brep::CadModel& model, const std::vector<std::vector<Cut>>& cuts);

/// Vertices of one set become the first of them, whose tolerance reaches the others.
void merge_vertices(brep::CadModel& model, brep::DisjointSets& sets);

/// How far a border is from its edge [length], whose tolerance is no less from now on.
double note_gap(brep::CadModel& model, const brep::CadFace& face, const brep::Trim& trim);

/// Leaves out edges and vertices that nothing uses; the others keep their order.
void drop_unused(brep::CadModel& model);

}  // namespace geometry_io
