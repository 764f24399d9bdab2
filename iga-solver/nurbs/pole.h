// SPDX-License-Identifier: GPL-2.0-or-later
// Poles: edges of a patch that are one point, as the tip of a cone.  All parameters along such an edge are
// the same foot, but each meets the surface in a direction of its own.
#pragma once

#include "nurbs/element_descent.h"

namespace nurbs {

/// Whether `at` lies on a pole that is a local minimum of |S - d|: no way from it into the patch leads
/// downhill.  The slopes of these ways are proved by their Bernstein coefficients; where they vanish, as for
/// d on the axis of a cap, curvatures decide at 17 places per element.
bool minimum_on_pole(const ElementStore& elements, const Vector3& d, const LocalPoint& at);

}  // namespace nurbs
