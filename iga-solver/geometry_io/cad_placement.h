// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "brep/cad_model.h"
#include "geometry_io/placement.h"

namespace geometry_io {

/// Turns, moves, and scales alike in all directions.  Throws std::invalid_argument of other placements, which
/// leave no cylinder one.
void place(brep::CadModel& model, const Placement& placement);

}  // namespace geometry_io
