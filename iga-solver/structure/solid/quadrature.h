// SPDX-License-Identifier: GPL-2.0-or-later
// Where the integrals of a solid are evaluated.
#pragma once

#include <string>
#include <vector>

#include "nurbs/gauss_legendre.h"
#include "nurbs/patch.h"

namespace structure {

/// Tensor products of Gauss points, so many per direction and knot span:
enum class Quadrature {
  full,     ///< p + 1: exact for affine maps of polynomial patches
  reduced,  ///< p: the same zero modes and the same stable step
  zou       ///< p - 1, and p in spans at the ends and beside repeated knots; degrees 2 and 3 only
};
// A span that is alone between two ends or C0 lines has p + 1 points in all of them: Legendre's polynomial of
// degree p would vanish at p, and the product of two such directions, times anything, is a motion without
// energy.
// Source of the last: Zou, Hughes, Scott, Miao & Sauer (2022), "Efficient and robust quadratures for
// isogeometric analysis", Comput. Methods Appl. Mech. Eng. 392, 114722.

const char* name(Quadrature quadrature);
/// Throws std::invalid_argument, naming all words, for another one.
Quadrature quadrature_from_name(const std::string& word);

/// The rules of all knot spans of one direction.  Throws std::invalid_argument if the quadrature is not for
/// this degree.
std::vector<nurbs::QuadratureRule> rules_of(const nurbs::KnotVector& knots, Quadrature quadrature);

/// Points of an element at most: of all directions together.
int points_per_element(const nurbs::Space<3>& space, Quadrature quadrature);

}  // namespace structure
