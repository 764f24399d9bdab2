// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces (3 x node_count) [force] of loads that do not depend on the motion.
#pragma once

#include "nurbs/boundary.h"
#include "structure/solid/solid.h"

namespace structure {

/// Integral of density g R_A over the volume: uniform acceleration g [length/time^2].
NodalVectors gravity_load(const Solid& solid, const Vector3& g);

/// Integral of t R_A over a face: uniform dead traction t [force/length^2], per reference area, direction
/// fixed in space.
NodalVectors traction_load(const nurbs::Volume& patch, nurbs::Face face, const Vector3& traction);

}  // namespace structure
