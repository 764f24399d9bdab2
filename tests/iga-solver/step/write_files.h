// SPDX-License-Identifier: GPL-2.0-or-later
// Parts as files.  Errors: std::runtime_error that names the file.
#pragma once

#include <string>

#include "parts.h"

namespace step_parts {

/// STEP or IGES by the ending.
void write(const Part& part, const std::string& folder);
/// With the shape that part.shape() gave.
void write(const Part& part, const TopoDS_Shape& shape, const std::string& path);
void write(const Assembly& assembly, const std::string& folder);

/// An assembly that names files beside it for its solids: stem_NAME.stp.
void write_by_reference(const Assembly& assembly, const std::string& path);

/// A STEP file as binary STL (mm) whose triangles lie within `deviation` mm of the faces.
void write_stl(const std::string& step_file, double deviation, const std::string& stl_file);

}  // namespace step_parts
