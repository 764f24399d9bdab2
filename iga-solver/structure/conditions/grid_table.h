// SPDX-License-Identifier: GPL-2.0-or-later
// Values of place and time by a table on a grid: linear between its rows in each direction, the outermost
// ones beyond.
#pragma once

#include <array>
#include <vector>

#include "structure/conditions/field.h"

namespace structure {

/// Rising places along x, y, z [length] and times t; an axis without any is one that nothing depends on.
using GridAxes = std::array<std::vector<double>, 4>;

/// `rows`: one for each point of the grid, the first of its axes fastest.  Throws std::invalid_argument
/// unless each axis rises and there are as many rows as points.
Field grid_table(GridAxes axes, std::vector<nurbs::Vector3> rows);

}  // namespace structure
