// SPDX-License-Identifier: GPL-2.0-or-later
// Poles: edges of a patch that are one point, as the tip of a cone.  All parameters along such an edge are
// the same foot, but each meets the surface in a direction of its own.
#pragma once

#include "search/element_descent.h"

namespace search {

/// What a pole is to |S - d|.
enum class PoleKind {
  none,     ///< no pole here
  minimum,  ///< no way into the patch leads downhill
  slope,    ///< one does, by its slope
  saddle    ///< slopes are none, and one bends down
};
struct Pole {
  PoleKind kind;
  LocalPoint at;  ///< if slope: downhill from the pole, one Newton step along a steep way
  Vector3 r;      ///< S - d
};

/// The pole beside `near` (less than 1e-5 of an element away).  The slopes of the ways into the patch are
/// proved by their Bernstein coefficients; where they are none (relative to |r|, below the root of round-off:
/// d is on the axis of a cap), curvatures decide: at 33 places per element, and at more between those where
/// their second difference is not below the least of them.
Pole pole_beside(const ElementStore& elements, const Vector3& d, const LocalPoint& near);

}  // namespace search
