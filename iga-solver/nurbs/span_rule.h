// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

#include "nurbs/gauss_legendre.h"
#include "nurbs/knot_vector.h"

namespace nurbs {

/// Degree + 2 Gauss points on a knot span, for areas and loads: products of a function, derivatives of
/// positions, and what the user gives.
inline QuadratureRule span_rule(const KnotVector& knots, int element) {
  return gauss_legendre(std::min(knots.degree() + 2, kMaxGaussPoints), knots.breaks()[element],
                        knots.breaks()[element + 1]);
}

}  // namespace nurbs
