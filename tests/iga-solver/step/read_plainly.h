// SPDX-License-Identifier: GPL-2.0-or-later
// A CAD file by OpenCASCADE's own readers as they are, without names and colours.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

namespace step_parts {

/// STEP or, by the ending, IGES; mm.  Throws std::runtime_error if there is no shape.
TopoDS_Shape read_plainly(const std::string& file);

/// No progress of OpenCASCADE's on standard output.
void silence();

}  // namespace step_parts
