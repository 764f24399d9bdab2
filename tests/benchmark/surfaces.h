// SPDX-License-Identifier: GPL-2.0-or-later
// The surfaces and points that all methods are timed on.
#pragma once

#include <string>
#include <vector>

#include "nurbs/patch.h"

namespace benchmarks {

/// A patch of n x n elements, degree 2, about 1 across: "plate" (flat), "wavy" (radius of curvature 0.2),
/// "cylinder" (exact quarter, rational) or "saddle" (parameter lines at 53 degrees).  Throws
/// std::invalid_argument for another name.
nurbs::Surface make_surface(const std::string& name, int n);

/// A point beside a surface whose foot is known.
struct Query {
  nurbs::Vector3 d;
  nurbs::Parameter<2> guess;  ///< 1 % of an element off the foot in either direction
  nurbs::Vector3 foot;        ///< the exact one
};

/// d = S(xi) + s n at random xi (order random, too) and |s| < 0.06: less than any radius of curvature and any
/// distance between two sheets of these surfaces, so S(xi) is the nearest point.
std::vector<Query> make_queries(const nurbs::Surface& surface, int count);

}  // namespace benchmarks
