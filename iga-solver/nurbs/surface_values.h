// SPDX-License-Identifier: GPL-2.0-or-later
// The functions R_A of a surface at one point, values alone, and sums over them: what a contact needs of
// them. From the power form of each direction's functions, so without the recursion of evaluate() (patch.h).
#pragma once

#include "nurbs/patch.h"

namespace nurbs {

/// R[i + (p+1) j] belongs to the control point first + i + stride j.
struct SurfaceValues {
  int p, q, first, stride;
  double R[power(kMaxDegree + 1, 2)];  ///< values, sum 1
};

/// Values at xi (clamped to the domain); equal to those of evaluate() but for round-off.
void evaluate_values(const Space<2>& space, const Parameter<2>& xi, SurfaceValues& out);

/// Sum of R_A q_A (q: 3 x n).
Vector3 interpolate(const SurfaceValues& values, const NodalVectors& q);
/// Adds R_A F to every f_A (f: 3 x n).
void distribute(const SurfaceValues& values, const Vector3& F, NodalVectors& f);

}  // namespace nurbs
