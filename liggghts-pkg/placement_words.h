// SPDX-License-Identifier: GPL-2.0-or-later
// The words that place a rigid wall, those of fix mesh/surface: scale, move and rotate, in the order given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry_io/placement.h"
#include "word_reader.h"

namespace liggghts_pkg {

/// "scale", ...; each may be repeated.
const std::vector<std::string>& placement_keywords();
/// Reads what stands after `keyword`, one of these, and does it after what `placement` does already.  Throws
/// std::invalid_argument: what was given, what was expected.
void read_placement(const std::string& keyword, WordReader& words,
                    std::optional<geometry_io::Placement>& placement);

}  // namespace liggghts_pkg
