// SPDX-License-Identifier: GPL-2.0-or-later
// How much of a surface belongs to each control point.
#pragma once

#include "nurbs/patch.h"

namespace nurbs {

/// area_A = integral of R_A over the surface with these control points (3 x n) [length^2]; their sum is the
/// surface's area.  Gauss-Legendre quadrature, p + 2 points per element and direction: exact for
/// parallelograms.
Eigen::VectorXd control_point_areas(const Space<2>& space, const NodalVectors& control_points);

}  // namespace nurbs
