// SPDX-License-Identifier: GPL-2.0-or-later
// How a foot moves over its patch as the centre above it moves along the surface.
#pragma once

#include <Eigen/Core>

#include "nurbs/patch.h"

namespace contact {

struct FootMotion {
  Eigen::Matrix<double, 3, 2> tangents;  ///< S_j, of the two parameters [length]
  Eigen::Matrix2d rates;                 ///< of the parameters by S_i . d(centre) [1/length^2]
};

/// On a patch whose control points are columns of X (3 x n) [length] from `first` on; `delta`: from the foot
/// to the centre, normal to the surface [length].  From (centre - S) . S_i = 0:
///   (S_i . S_j - delta . S_ij) d(xi_j) = S_i . d(centre) - sum over A of (R_A S_i - R_A,i delta) . d(X_A),
/// so over a hill the foot is slower than the centre, and in a hollow faster; and what moves it by turning
/// the surface below the centre, the last term, is a couple for a force that depends on the foot.
FootMotion foot_motion(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi,
                       const nurbs::NodalVectors& X, int first, const nurbs::Vector3& delta);

}  // namespace contact
