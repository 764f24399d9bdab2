// SPDX-License-Identifier: GPL-2.0-or-later
// Sides of pieces, which edges are made of.  Side i of piece p has the number 4 p + i.
#pragma once

#include "brep/surface.h"

namespace brep {

inline int side_number(int piece, int i) { return 4 * piece + i; }
inline int piece_of_side(int side) { return side / 4; }

/// How a face meets its border, at one point of it; along the border this turns with it.
struct Side {
  Vector3 at, conormal, normal;  ///< conormal: into the face
};
Side side_at(const Surface& surface, int side);
/// The border from where it begins to where it ends, counterclockwise round the face; without faces.
Edge curve_of(const Surface& surface, int side);

/// Of a face that is no plane: whether its side i is a border, neither a seam nor a pole.
bool is_border(const Face& face, int i);
/// Where side i begins.
Parameter<2> corner_parameters(const Face& face, int i);

}  // namespace brep
