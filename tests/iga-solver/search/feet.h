// SPDX-License-Identifier: GPL-2.0-or-later
// The searches of SurfaceProjector on a surface used once.
#pragma once

#include <vector>

#include "search/surface_projector.h"

namespace search {

inline Foot closest(const nurbs::Surface& surface, const Vector3& d) {
  const SurfaceProjector projector(surface.space, surface.control_points);
  return projector.cold(d);
}

inline Foot closest_from(const nurbs::Surface& surface, const Vector3& d, const Parameter<2>& guess) {
  const SurfaceProjector projector(surface.space, surface.control_points);
  return projector.warm(d, guess);
}

/// Feet of many points at a time, each from its guess.
inline std::vector<Foot> closest_from(const SurfaceProjector& projector, const std::vector<Vector3>& d,
                                      const std::vector<Parameter<2>>& guesses) {
  std::vector<Foot> feet(d.size());
  std::vector<Foot*> places;
  for (size_t k = 0; k < d.size(); ++k) {
    feet[k].xi = guesses[k];
    places.push_back(&feet[k]);
  }
  projector.warm_batch(d.data(), places.data(), static_cast<int>(d.size()));
  return feet;
}

}  // namespace search
