// SPDX-License-Identifier: GPL-2.0-or-later
// The patches of a wall as its faces.
#pragma once

#include <optional>
#include <vector>

#include "brep/chart.h"
#include "brep/surface.h"
#include "nurbs/patch.h"

namespace brep {

/// Faces with the patches' numbers.
struct FacedPatches {
  Surface surface;
  std::vector<Chart> charts;  ///< of faces in closed form; none: faces have the parameters of their patches
};

/// How patches meet decides: where two turn by more than `edge_angle` [rad] they are faces, in closed form if
/// all have one, and so are those given by words (`from_words`) if all have a closed form.  Nothing for
/// others, which are smooth, or turn inside (at C0 knots), or where more than two meet in one edge: their
/// feet are searched as those of one surface (search::MultiPatchProjector).  Throws std::invalid_argument as
/// nurbs::check_patch does.
std::optional<FacedPatches> faced_patches(const std::vector<nurbs::Surface>& patches, bool from_words,
                                          double edge_angle);

/// Patches in closed form alone; nothing unless all are.
std::optional<FacedPatches> closed_forms(const std::vector<nurbs::Surface>& patches, double edge_angle);

/// The patches as faces of a CAD model, each with one loop along its sides; welded sides share an edge.
CadModel model_of(const std::vector<nurbs::Surface>& patches, const nurbs::Borders& borders);

}  // namespace brep
