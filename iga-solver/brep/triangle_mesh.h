// SPDX-License-Identifier: GPL-2.0-or-later
// The triangles of a wall of plane faces, for who draws or writes them.
#pragma once

#include "brep/surface.h"
#include "nurbs/tessellation.h"

namespace brep {

/// One per piece, in this order.
nurbs::TriangleMesh triangles_of(const Surface& surface);

}  // namespace brep
