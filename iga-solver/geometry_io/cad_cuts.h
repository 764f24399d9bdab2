// SPDX-License-Identifier: GPL-2.0-or-later
// Edges of a CAD model that are cut, and what is left of a model when some of them are no longer used.
#pragma once

#include <vector>

#include "brep/cad_model.h"

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

/// Leaves out edges and vertices that nothing uses; the others keep their order.
void drop_unused(brep::CadModel& model);

}  // namespace geometry_io
