// SPDX-License-Identifier: GPL-2.0-or-later
// Source for triangles: Ericson (2005), Real-Time Collision Detection, section 5.1.5.
#pragma once

#include "brep/surface.h"

namespace brep {

/// Distance of d from a triangle; from the whole surface that another face is cut from, from what encloses
/// a chunk of a spline, from a box around an element, which are not more.
double distance_of_piece(const Surface& surface, int piece, const Vector3& d);

}  // namespace brep
