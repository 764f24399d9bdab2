// SPDX-License-Identifier: GPL-2.0-or-later
// The functions R_A of a surface at one point and their first derivatives, and sums over them, as
// surface_values.h has them without derivatives.
#pragma once

#include <Eigen/Core>

#include "nurbs/surface_values.h"

namespace nurbs {

using Tangents = Eigen::Matrix<double, 3, 2>;

struct SurfaceSlopes {
  SurfaceValues values;
  double dR[2][power(kMaxDegree + 1, 2)];  ///< with the parameters, in the order of R; each sums to 0
};

/// At xi (clamped to the domain); equal to evaluate() (patch.h) but for round-off.
void evaluate_slopes(const Space<2>& space, const Parameter<2>& xi, SurfaceSlopes& out);

/// Columns: sum of dR_A/dxi_j q_A (q: 3 x n).
Tangents interpolate_slopes(const SurfaceSlopes& slopes, const NodalVectors& q);
/// Adds R_A F + dR_A/dxi_j G_j to every f_A (f: 3 x n).
void distribute(const SurfaceSlopes& slopes, const Vector3& F, const Tangents& G, NodalVectors& f);

}  // namespace nurbs
