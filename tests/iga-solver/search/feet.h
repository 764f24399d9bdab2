// SPDX-License-Identifier: GPL-2.0-or-later
// The searches of SurfaceProjector on a surface used once.
#pragma once

#include "search/surface_projector.h"

namespace search {

inline Projection closest(const nurbs::Surface& surface, const Vector3& d) {
  SurfaceProjector projector(surface.space);
  projector.set_control_points(surface.control_points);
  return projector.cold(d);
}

inline Projection closest_from(const nurbs::Surface& surface, const Vector3& d, const Parameter<2>& guess) {
  SurfaceProjector projector(surface.space);
  projector.set_control_points(surface.control_points);
  return projector.warm(d, guess);
}

}  // namespace search
