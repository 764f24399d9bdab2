// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces (3 x n) [force] of loads that do not depend on the motion.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "structure/body.h"
#include "structure/conditions/columns.h"
#include "structure/conditions/field.h"
#include "structure/conditions/probe.h"
#include "structure/conditions/skin_surface.h"
#include "structure/id.h"

namespace structure {

/// Integral of density g R_A over the volume: uniform acceleration g [length/time^2].
NodalVectors gravity_load(const Body& body, const Vector3& g);

/// Of the nodes of a piece of the skin, by their ids, the areas [length^2] that a traction counts on.
std::vector<std::pair<Id, double>> skin_areas(const SkinSurface& skin);
/// On the nodes of a body in one piece, integral of t R_A over a piece of the skin: uniform dead traction t
/// [force/length^2], per reference area, direction fixed in space.
NodalVectors traction_load(const Body& body, const SkinPiece& piece, const Vector3& traction);
/// Adds the same to forces f on a part.
void add_traction_load(const SkinSurface& skin, const Vector3& traction, const Columns& columns,
                       NodalVectors& f);

// The same for forces at a point [force], along an edge of a patch [force/length], where two of its faces
// meet, and in its volume [force/length^3].  `ids`: nodes of the whole body, per control point.

void add_point_load(const Probe& point, const Vector3& force, const Columns& columns, NodalVectors& f);
void add_line_load(const nurbs::Volume& patch, const std::vector<Id>& ids,
                   const std::array<nurbs::Face, 2>& edge, const Field& load, const Columns& columns,
                   NodalVectors& f);
void add_body_force(const nurbs::Volume& patch, const std::vector<Id>& ids, const Field& force,
                    const Columns& columns, NodalVectors& f);

}  // namespace structure
