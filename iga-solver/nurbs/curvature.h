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
/// Of one patch with its control points; of a pole, which has no curvature, that of a point beside it.
SurfaceShape shape_near(const Space<2>& patch, const Eigen::Ref<const NodalVectors>& control_points,
                        Parameter<2> xi);
/// The same as seen from one closed element of a patch, with the patch's control points.
SurfaceShape shape_on_element(const Space<2>& patch, const Eigen::Ref<const NodalVectors>& control_points,
                              int element, const Parameter<2>& xi);

}  // namespace nurbs
