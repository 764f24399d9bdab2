// SPDX-License-Identifier: GPL-2.0-or-later
// Which triangles share sides: in linear time, by the lower of the two points.
#pragma once

#include <array>
#include <vector>

#include "brep/assembly.h"

namespace brep {

/// Sides of triangles (numbered as those of pieces, sides.h) that have the same two of `points` points; mates
/// wherever two meet.
MatchedSides match(long points, const std::vector<std::array<int, 3>>& triangles);

/// Leaves the first of triangles with the same three points, and its number; returns how many went.
int leave_out_duplicates(long points, std::vector<std::array<int, 3>>& triangles, std::vector<int>& number);

}  // namespace brep
