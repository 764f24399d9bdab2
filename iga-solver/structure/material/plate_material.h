// SPDX-License-Identifier: GPL-2.0-or-later
// From a material to what it is in a plate of a single quadratic layer (plate_shear.h).
#pragma once

#include <memory>

#include "structure/material/material.h"

namespace structure {

/// The same material in a plate of that normal.  Throws std::invalid_argument, naming the law, if that is
/// another one than linear_elastic and saint_venant_kirchhoff.
std::shared_ptr<const Material> with_plate_shear(const Material& material, const Eigen::Vector3d& normal);

/// Whether it is of one, viscous or not.
bool has_plate_shear(const Material& material);

}  // namespace structure
