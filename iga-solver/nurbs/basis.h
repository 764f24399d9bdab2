// SPDX-License-Identifier: GPL-2.0-or-later
// B-spline basis functions of one direction.
// Source: Cox (1972), de Boor (1972); Piegl & Tiller (1997), eq. 2.5, algorithms A2.2 and A2.3.
// Gao & Feng (2019) print eq. 2 with a wrong second numerator: it is (xi_{i+p+1} - xi), not (xi_{i+p+1} -
// xi_i).
#pragma once

#include "nurbs/knot_vector.h"

namespace nurbs {

/// The p+1 functions that are not zero on one knot span, and their derivatives.
struct BasisFunctions {
  int first;                         ///< index of the first of them (0-based control point)
  double values[3][kMaxDegree + 1];  ///< [k][j] = d^k N_{first+j} / d xi^k   [1 / parameter^k]
};

/// Values and derivatives up to `derivatives` (0, 1 or 2) at xi, which must lie in the closed knot span
/// `span` (so one-sided derivatives at a knot are chosen by the span).
void evaluate_basis(const KnotVector& knots, int span, double xi, int derivatives, BasisFunctions& out);

/// Blossom (polar form) of the spline on knot span `span`: f(t[0], ..., t[p-1]) = sum_j out[j] P_{span-p+j}.
/// With every t = xi, f is the point at xi and out the basis; with p consecutive knots of a finer knot
/// vector, f is one of its control points.  Source: Ramshaw (1989), "Blossoms are polar forms"; Cohen, Lyche
/// & Riesenfeld (1980).
void evaluate_blossom(const KnotVector& knots, int span, const double* t, double* out);

/// The functions N_{first+j} of one element as polynomials in s, -1 <= s <= 1 on it.
/// Source: Piegl & Tiller (1997), section 6.6.
struct ElementFunctions {
  double bezier[kMaxDegree + 1][kMaxDegree + 1];  ///< [k][j]: coefficient of N_{first+j} at Bernstein k
  double power[kMaxDegree + 1][kMaxDegree + 1];   ///< [k][j]: that at s^k
};
/// Of all elements.
std::vector<ElementFunctions> element_functions(const KnotVector& knots);

/// C(n, k)
double binomial(int n, int k);

}  // namespace nurbs
