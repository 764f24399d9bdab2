// SPDX-License-Identifier: GPL-2.0-or-later
// Local search: closest-point projection of a point on a NURBS surface.
// Minimises half the squared distance phi = |S(xi, eta) - d|^2 / 2 over the parameter rectangle: Newton with
// the exact Hessian; where that is not positive definite, with its diagonal alone, reflected; backtracking,
// and an active set on the rectangle's edges.  (Gauss-Newton, the usual remedy for an indefinite Hessian,
// crawls along curved valleys.) Source: Piegl & Tiller (1997), section 6.1; Gao & Feng (2019), eqs. 27-28
// (the interior case); active set after Bertsekas (1982), "Projected Newton methods", SIAM J. Control
// Optim. 20.
//
// A patch may have creases (C0 knot lines): the search walks over the smooth regions between them, and a foot
// on a crease is the minimum seen from both sides.  A foot on a pole (an edge that is one point) and a
// stationary point that is no minimum are left again.
#pragma once

#include "nurbs/patch.h"

namespace nurbs {

enum class ProjectionStatus {
  interior,      ///< foot inside the patch: d - S is normal to the surface
  edge,          ///< foot on an edge of the patch or on a crease
  corner,        ///< foot on a corner of these
  not_converged  ///< iteration limit reached; the foot is the best point found
};

struct Projection {
  Parameter<2> xi;  ///< parameters of the foot
  Vector3 foot;     ///< S(xi) [length]
  double distance;  ///< |d - foot| [length]
  ProjectionStatus status;
  int iterations;
};

/// Local minimum reached from `guess`.  Tolerances are relative to the size of the surface and the round-off
/// of the evaluation, so scaling all lengths changes nothing.  No allocation.
Projection closest_point_from(const Space<2>& space, const NodalVectors& control_points, const Vector3& d,
                              const Parameter<2>& guess);

/// Smallest of the local minima reached from samples of the given elements (cold search on candidates of a
/// BoxTree). Throws std::invalid_argument if there are no elements.
Projection closest_point_on_elements(const Space<2>& space, const NodalVectors& control_points,
                                     const Vector3& d, const int* elements, int element_count);

}  // namespace nurbs
