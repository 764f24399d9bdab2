// SPDX-License-Identifier: GPL-2.0-or-later
// How a foot moves over its patch as the centre above it moves along the surface.
#pragma once

#include <Eigen/Core>

#include "nurbs/patch.h"

namespace contact {

/// Of all control points, 3 x n [length].
struct Places {
  const nurbs::NodalVectors &now, &undeformed;
};

struct FootMotion {
  nurbs::Vector3 first;                   ///< dS/dxi of the patch [length]
  Eigen::Matrix<double, 3, 2> gradients;  ///< of the two parameters with the centre's place [1/length]
};

/// On a patch whose control points are columns of X from `first` on; `delta`: from the foot to the centre,
/// normal to the surface [length].  From (centre - S) . S_i = 0:
///   (S_i . S_j - delta . S_ij) d(xi_j) = S_i . d(centre),
/// so over a hill the foot is slower than the centre, and in a hollow faster.  S_ij are those of the
/// undeformed surface: the dent below a ball goes along with it, and does not bend its way.
FootMotion foot_motion(const nurbs::Space<2>& space, const nurbs::Parameter<2>& xi, const Places& X,
                       int first, const nurbs::Vector3& delta);

}  // namespace contact
