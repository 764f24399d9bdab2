// SPDX-License-Identifier: GPL-2.0-or-later
// A wall as a CAD file would have it: every face with loops, seams, poles.
#pragma once

#include "brep/cad_model.h"
#include "brep/surface.h"

namespace brep::trials {

/// Of walls from triangles or from faces; numbers of faces stay.  `as_patches`: faces as NURBS of the same
/// shape.
CadModel cad_of(const Surface& wall, bool as_patches = false);

}  // namespace brep::trials
