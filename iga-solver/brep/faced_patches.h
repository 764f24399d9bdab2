// SPDX-License-Identifier: GPL-2.0-or-later
// The patches of a wall as its faces.
#pragma once

#include <optional>
#include <vector>

#include "brep/chart.h"
#include "brep/patch_parts.h"
#include "brep/surface.h"
#include "nurbs/patch.h"

namespace brep {

struct FacedPatches {
  Surface surface;
  std::vector<Chart> charts;  ///< of faces in closed form; none: faces have the parameters of their patches
  PatchParts parts;           ///< face f is part f of the patches
};

/// How patches meet decides: where two turn at their sides by more than `edge_angle` [rad], where one turns
/// inside (at C0 knots), or where more than two meet in one edge they are faces, in closed form if all parts
/// have one, and so are those given by words (`from_words`) if all have a closed form.  Nothing for others,
/// which are smooth, or of which a part has no area: their feet are searched as those of one surface
/// (search::MultiPatchProjector).  Throws std::invalid_argument as nurbs::check_patch does.
std::optional<FacedPatches> faced_patches(const std::vector<nurbs::Surface>& patches, bool from_words,
                                          double edge_angle);

/// Patches in closed form alone; nothing unless all are.
std::optional<FacedPatches> closed_forms(const std::vector<nurbs::Surface>& patches, double edge_angle);

/// The patches as faces of a CAD model, each with one loop along its sides; sides that are one curve share an
/// edge.
CadModel model_of(const std::vector<nurbs::Surface>& patches, const nurbs::Borders& borders);

}  // namespace brep
