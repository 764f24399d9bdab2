// SPDX-License-Identifier: GPL-2.0-or-later
// Knot insertion and degree elevation: the geometry stays the same, exactly.
// Both are one rule, a blossom at consecutive knots of the new knot vector: Cohen, Lyche & Riesenfeld (1980),
// "Discrete B-splines" (the Oslo algorithm), and Prautzsch (1984), "Degree elevation of B-spline curves"; the
// operations are those of Piegl & Tiller (1997), sections 5.2-5.5.
#pragma once

#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

/// Inserts knots in one direction, in any order, repeated ones too, all at once.  Throws
/// std::invalid_argument if one lies outside the open domain or its multiplicity would exceed the degree.
template <int Dim>
Patch<Dim> insert_knots(const Patch<Dim>& patch, int direction, const std::vector<double>& added);

/// Inserts `xi` `times` times in one direction; throws as insert_knots.
template <int Dim>
Patch<Dim> insert_knot(const Patch<Dim>& patch, int direction, double xi, int times = 1);

/// Raises the degree in one direction by `times`; every knot's multiplicity rises by as much, so continuity
/// stays. Throws std::invalid_argument above kMaxDegree.
template <int Dim>
Patch<Dim> elevate_degree(const Patch<Dim>& patch, int direction, int times = 1);

/// The part of a patch between two parameters of one direction, with the same parameters; knots are inserted
/// where an end of it has fewer than the degree.  Throws std::invalid_argument unless begin < end, both in
/// the range.
template <int Dim>
Patch<Dim> part_between(const Patch<Dim>& patch, int direction, double begin, double end);

}  // namespace nurbs
