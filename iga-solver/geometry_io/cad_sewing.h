// SPDX-License-Identifier: GPL-2.0-or-later
// Borders of sheets that run side by side become common edges.
#pragma once

#include <vector>

#include "brep/cad_model.h"
#include "geometry_io/cad_sheets.h"

namespace geometry_io {

/// Joins free edges of the faces of some solids of the model, which are sheets, with other edges of them
/// where they run side by side no farther apart than `tolerance`: the nearest first, those in one place
/// before all. An edge that goes on beside a shorter one is cut there.  Left free are borders of which one
/// lies back on the other as the pages of a book do (faces within 0.02 rad of each other), and what would
/// make an edge vanish or a face narrower than `tolerance` a seam.  What is replaced stays in the model,
/// unused (drop_unused).
Sewn sew(brep::CadModel& model, const std::vector<int>& solids, double tolerance);

}  // namespace geometry_io
