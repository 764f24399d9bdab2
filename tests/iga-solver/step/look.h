// SPDX-License-Identifier: GPL-2.0-or-later
// What OpenCASCADE sees in a CAD file.
#pragma once

#include <iosfwd>
#include <string>

namespace step_parts {

/// One line of kinds and degrees, edges, largest tolerance, and whether BRepCheck_Analyzer finds it valid.
void look(const std::string& file, std::ostream& out);

}  // namespace step_parts
