// SPDX-License-Identifier: GPL-2.0-or-later
// What a closest-point search returns.
#pragma once

#include "search/names.h"

namespace search {

enum class ProjectionStatus {
  interior,      ///< foot inside the patch: d - S is normal to the surface
  edge,          ///< foot on an edge of the patch or on a crease
  corner,        ///< foot on a corner of these
  not_converged  ///< no foot: the point, the guess or control points are not finite (simplex_brent.h: gave
                 ///< up)
};

struct Projection {
  Parameter<2> xi;  ///< parameters of the foot
  Vector3 foot;     ///< S(xi) [length]
  double distance;  ///< |d - foot| [length]
  ProjectionStatus status;
  int iterations;  ///< of the descent that found the foot
};

}  // namespace search
