// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces (3 x n) [force] of loads that do not depend on the motion.
#pragma once

#include <vector>

#include "structure/body.h"
#include "structure/id.h"

namespace structure {

/// Integral of density g R_A over the volume: uniform acceleration g [length/time^2].
NodalVectors gravity_load(const Body& body, const Vector3& g);

/// On the nodes of a body in one piece, integral of t R_A over a piece of the skin: uniform dead traction t
/// [force/length^2], per reference area, direction fixed in space.
NodalVectors traction_load(const Body& body, const SkinPiece& piece, const Vector3& traction);
/// Adds the same to forces f on a part: a column for each id of `nodes`, -1 for columns of no node.
/// X: undeformed positions of the control points of the face [length].
void add_traction_load(const nurbs::BoundarySurface& face, const NodalVectors& X, const Vector3& traction,
                       const std::vector<Id>& nodes, NodalVectors& f);

}  // namespace structure
