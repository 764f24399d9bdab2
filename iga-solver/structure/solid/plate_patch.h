// SPDX-License-Identifier: GPL-2.0-or-later
// Patches that are plates of a single quadratic element through the thickness: where shear strain is even
// that should be a parabola (material/plate_shear.h).
#pragma once

#include "nurbs/patch.h"

namespace structure {

using nurbs::Vector3;

/// The direction in which the patch is one quadratic element thick; -1 if there is none, or more than one.
int thickness_direction(const nurbs::Space<3>& space);

/// Unit normal of the surface that parameter `direction` is constant on, to larger ones.
Vector3 layer_normal(const nurbs::Volume& patch, int direction, const nurbs::Parameter<3>& xi);

/// That of a flat plate.  Throws std::invalid_argument unless its layers of control points are parallel
/// planes at equal distances.
Vector3 plate_normal(const nurbs::Volume& patch, int direction);

}  // namespace structure
