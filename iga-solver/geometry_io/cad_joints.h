// SPDX-License-Identifier: GPL-2.0-or-later
// Borders of sheets that stand on other faces become edges of these, too: the foot of a T.
#pragma once

#include <vector>

#include "brep/cad_model.h"
#include "geometry_io/cad_sheets.h"

namespace geometry_io {

/// Free edges of one solid of the model, which is a sheet, that run inside of another of its faces, no
/// farther from it than `tolerance`, become edges in that face: twice in its loops, once for each side.  They
/// are cut where they cross its border, which is cut there as well.  Left as they are: faces that lie flat on
/// the other one (within 0.02 rad), and edges on patches, which have no closed form.  What is replaced
/// stays in the model, unused (drop_unused).
Sewn join_to_faces(brep::CadModel& model, const std::vector<int>& solids, double tolerance);

}  // namespace geometry_io
