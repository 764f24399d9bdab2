// SPDX-License-Identifier: GPL-2.0-or-later
// Directions along a wall of patches as it now is: what changes along the surface is worked out with.
#pragma once

#include <array>

#include "coupling/contact/wall.h"

namespace contact {

struct SurfaceDirections {
  Vector3 first;  ///< dS/dxi of the patch, in space [length]
  std::array<Vector3, 2>
      dual;  ///< gradients of a foot's two parameters with the centre's place, in space [1/length]

  /// Of what changes with the parameters like this.
  Vector3 gradient(const std::array<double, 2>& change) const {
    return change[0] * dual[0] + change[1] * dual[1];
  }
};

}  // namespace contact
