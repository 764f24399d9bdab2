// SPDX-License-Identifier: GPL-2.0-or-later
// A rigid NURBS plane from outside: projects a point on it.  Exit code 0 if the distance is right.
#include <cmath>

#include "coupling/rigid/rigid_surface.h"
#include "nurbs/primitives.h"
#include "search/surface_projector.h"

int main() {
  const auto knots = nurbs::KnotVector::uniform(3, 4);
  const coupling::RigidSurface plane({nurbs::plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {knots, knots})});
  const search::SurfaceProjector projector(plane.surface().topology.patch(0), plane.positions());
  const search::Foot foot = projector.cold({0.3, 0.6, 0.25});
  return std::abs(foot.distance - 0.25) < 1e-14 ? 0 : 1;
}
