// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

#include "nurbs/gauss_legendre.h"
#include "nurbs/knot_vector.h"

namespace structure {

/// Degree + 2 Gauss points on a knot span, as nurbs::control_point_areas has: loads are products of a
/// function, derivatives of positions, and what the user gives.
inline nurbs::QuadratureRule span_rule(const nurbs::KnotVector& knots, int element) {
  return nurbs::gauss_legendre(std::min(knots.degree() + 2, nurbs::kMaxGaussPoints), knots.breaks()[element],
                               knots.breaks()[element + 1]);
}

}  // namespace structure
