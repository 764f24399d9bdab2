// SPDX-License-Identifier: GPL-2.0-or-later
// Walls of triangles as other programs write them to STL files: rounded, in any order, with what is not
// needed.
#pragma once

#include <string>

#include "trial_walls.h"

namespace brep::trials {

/// Cuts triangles of the wall into thin and tiny ones, in the same planes and without new gaps.
void cut_finely(Wall& wall, std::mt19937& random);

/// ASCII, with 7 or 9 digits and in one to three solids, or binary.  Corners that triangles share differ in
/// the last digits (not with 7: these are rounding enough); some triangles are turned over, some are there
/// twice, and some have two corners at one place.
std::string stl_file(const Wall& wall, std::mt19937& random);

}  // namespace brep::trials
