// SPDX-License-Identifier: GPL-2.0-or-later
// Points of a wall by face and parameters, whether the face is in closed form or a patch.
#pragma once

#include <algorithm>

#include "brep/surface.h"

namespace brep {

inline Vector3 point_on(const Surface& surface, int face, const Parameter<2>& xi) {
  const Face& shape = surface.faces[face];
  return shape.kind == Kind::nurbs ? surface.patches->point(shape.patch, xi) : shape.point(xi);
}

/// Of a patch's pole that of a point beside it.
inline Vector3 normal_on(const Surface& surface, int face, const Parameter<2>& xi) {
  const Face& shape = surface.faces[face];
  return shape.kind == Kind::nurbs ? surface.patches->normal(shape.patch, xi) : shape.normal(xi);
}

/// Point, normal, and curvatures, positive towards that [1/length]; of a patch's pole those beside it.
inline nurbs::SurfaceShape shape_on(const Surface& surface, int face, const Parameter<2>& xi) {
  const Face& shape = surface.faces[face];
  if (shape.kind == Kind::nurbs) return surface.patches->shape(shape.patch, xi);
  const Parameter<2> k = shape.curvatures(xi);
  return {shape.point(xi), shape.normal(xi), {std::min(k[0], k[1]), std::max(k[0], k[1])}};
}

}  // namespace brep
