// SPDX-License-Identifier: GPL-2.0-or-later
// Which control points of volume patches are one node.
#pragma once

#include <utility>
#include <vector>

#include "nurbs/patch.h"
#include "structure/body.h"
#include "structure/node_numbering.h"

namespace structure {

/// Welds control points on the faces of the patches that stand at the same place, within `relative_tolerance`
/// times the extent of all.  Faces that are one surface must have one mesh, and patches meet in whole faces,
/// one on each side: throws std::invalid_argument that names them if their degrees, knots, control points or
/// weights differ, some of a face's inner control points alone stand where another patch has one, or both are
/// on one side, as a patch that is given twice.
NodeNumbering weld(const std::vector<nurbs::Volume>& patches, double relative_tolerance = 1e-9);

/// Every patch on its own.
NodeNumbering without_welds(const std::vector<nurbs::Volume>& patches);

/// The faces that are not welded to another one.
std::vector<SkinPiece> free_faces(const std::vector<nurbs::Space<3>>& patches, const NodeNumbering& nodes);

/// The others, each with the one that it is welded to.
std::vector<std::pair<SkinPiece, SkinPiece>> welded_faces(const std::vector<nurbs::Space<3>>& patches,
                                                          const NodeNumbering& nodes);

}  // namespace structure
