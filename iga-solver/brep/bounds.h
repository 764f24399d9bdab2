// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes and discs around pieces of a wall.
#pragma once

#include "brep/surface.h"

namespace brep {

struct Bounds {
  Vector3 low, high;
};

/// Around the range of a face's parameters: tight for planes and cylinders, else at most a few times too
/// large.
Bounds bounds_of(const Face& face);
/// Of a piece, appended: several boxes of trimmed faces and arcs, of others one.
void add_boxes(const Surface& surface, const Piece& piece, std::vector<Bounds>& boxes);

/// The smallest circle around a triangle.
struct Circle {
  Vector3 centre;
  double radius;
};
Circle circle_around(const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace brep
