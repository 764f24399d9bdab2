// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "brep/cad_model.h"

namespace geometry_io {

/// A page on what a CAD file holds, for people: unit, solids, faces, how they meet, what was healed.
std::string cad_text(const brep::CadModel& model);

}  // namespace geometry_io
