// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces (3 x n) [force] of loads that do not depend on the motion.
#pragma once

#include "structure/body.h"

namespace structure {

/// Integral of density g R_A over the volume: uniform acceleration g [length/time^2].
NodalVectors gravity_load(const Body& body, const Vector3& g);

/// On the nodes of the whole body, integral of t R_A over a piece of the skin: uniform dead traction t
/// [force/length^2], per reference area, direction fixed in space.
NodalVectors traction_load(const Body& body, const SkinPiece& piece, const Vector3& traction);

}  // namespace structure
