// SPDX-License-Identifier: GPL-2.0-or-later
// Triangles as an STL file in ASCII, which every program reads that reads STL.
#pragma once

#include <string>

#include "nurbs/tessellation.h"

namespace vtk {

/// One `solid` of that name; nine digits, enough for the single precision of most readers.  The file is whole
/// or not there.  Throws std::runtime_error that names it if it cannot be written.
void write_stl(const std::string& path, const std::string& name, const nurbs::TriangleMesh& mesh);

}  // namespace vtk
