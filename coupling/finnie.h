// SPDX-License-Identifier: GPL-2.0-or-later
// Erosion of a ductile surface by particles that cut into it.  Source: Finnie (1960), "Erosion of surfaces by
// solid particles", Wear 3; with the prefactor of LIGGGHTS' mesh module `stress ... wear finnie`.
#pragma once

#include <cmath>

#include "nurbs/types.h"

namespace coupling {

/// Volume worn off per time, 2 k |v| F f(gamma) [length^3/time]; gamma is the angle between v and the
/// surface:
///   f = sin(2 gamma) - 3 sin^2(gamma)   where 3 sin(gamma) <= cos(gamma),   else cos^2(gamma) / 3;
/// none for a particle that moves away.  v: velocity relative to the surface [length/time]; normal: unit,
/// towards the particle; force: |contact force|; k: Finnie's constant [1/pressure].
inline double finnie_wear_rate(const nurbs::Vector3& v, const nurbs::Vector3& normal, double force,
                               double k) {
  const double speed = v.norm(), approach = -v.dot(normal);
  if (approach < 0.0 || speed == 0.0) return 0.0;
  const double sine = std::fmin(approach / speed, 1.0), cosine = std::sqrt(1.0 - sine * sine);
  const double f = 3.0 * sine > cosine ? cosine * cosine / 3.0 : 2.0 * sine * cosine - 3.0 * sine * sine;
  return 2.0 * k * speed * force * f;
}

}  // namespace coupling
