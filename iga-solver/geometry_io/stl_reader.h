// SPDX-License-Identifier: GPL-2.0-or-later
// STL files, ASCII and binary, told apart by what they hold: a binary one may begin with "solid", too.
//
// ASCII: words between blanks, in capitals or not, in any layout but for the name, which stands in the line
// of its `solid`, up to a ';' or '#'; the last `endsolid` may be missing.  A solid called "all" goes with
// all.  Binary: 80 bytes of anything, the number of triangles, 50 bytes for each (normal and three corners
// in single precision, 2 bytes of anything), all little endian.  Normals are passed over, right or wrong: the
// corners say all.
// Source: 3D Systems (1989), StereoLithography Interface Specification.
#pragma once

#include <string>

#include "geometry_io/triangle_mesh.h"

namespace geometry_io {

/// Throws InputError with file and line, or byte from 0: what was given, what was expected.  A binary file is
/// one block without a name.
TriangleSoup read_stl(const std::string& bytes, const std::string& file);
TriangleSoup read_stl_text(const std::string& text, const std::string& file);

}  // namespace geometry_io
