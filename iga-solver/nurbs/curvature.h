// SPDX-License-Identifier: GPL-2.0-or-later
// The shape of a surface at a point, to second order.  Source: do Carmo (1976), section 3-3.
#pragma once

#include "nurbs/multi_patch.h"

namespace nurbs {

struct SurfaceShape {
  Vector3 point;        ///< S [length]
  Vector3 normal;       ///< dS/dxi x dS/deta, of length 1; not a number at poles
  double curvature[2];  ///< principal, least first, positive towards the normal [1/length]; infinite at poles
};

/// Control points of the whole surface (3 x n).  On knots as seen from the element right of them.
SurfaceShape shape_at(const MultiPatch& surface, const NodalVectors& control_points, const SurfacePoint& at);
/// The same, but of a pole, which has no curvature, that of a point beside it.
SurfaceShape shape_near(const MultiPatch& surface, const NodalVectors& control_points, SurfacePoint at);
/// The same as seen from one closed element of a patch.
SurfaceShape shape_on_element(const MultiPatch& surface, const NodalVectors& control_points, int patch,
                              int element_of_patch, const Parameter<2>& xi);

}  // namespace nurbs
