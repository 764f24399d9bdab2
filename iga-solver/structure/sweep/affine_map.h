// SPDX-License-Identifier: GPL-2.0-or-later
// Whether a patch is an affine image of its parameters.
#pragma once

#include <optional>

#include "nurbs/patch.h"
#include "structure/material/material.h"

namespace structure {

/// J = dX/dxi if it is the same everywhere to round-off: control points lie at the images of the Greville
/// abscissae, which reproduce linear functions (Schoenberg & Greville 1967).
std::optional<Matrix3> affine_jacobian(const nurbs::Volume& patch);

}  // namespace structure
