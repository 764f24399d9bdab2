// SPDX-License-Identifier: GPL-2.0-or-later
// Directions along a wall of patches as it now is: what changes along the surface is worked out with.
#pragma once

#include <Eigen/Core>
#include <array>

#include "coupling/contact/wall.h"

namespace contact {

struct SurfaceDirections {
  Eigen::Matrix<double, 3, 2> tangents;  ///< S_j of the patch, in space [length]
  Eigen::Matrix2d rates;                 ///< foot_motion.h [1/length^2]

  /// Of what changes with the parameters like this, the gradient with the centre's place along S_j.
  Eigen::Vector2d gradient(const std::array<double, 2>& change) const {
    return rates * Eigen::Vector2d(change[0], change[1]);
  }
};

}  // namespace contact
