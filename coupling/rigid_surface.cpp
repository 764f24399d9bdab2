// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/rigid_surface.h"

#include <limits>
#include <stdexcept>

namespace coupling {

RigidSurface::RigidSurface(nurbs::Surface surface, int outward_sign)
    : surface_{surface.space, SurfaceMap::identity(surface.space.control_point_count()), outward_sign},
      positions_(std::move(surface.control_points)),
      velocities_(NodalVectors::Zero(3, positions_.cols())) {}

double RigidSurface::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidSurface::load(const std::vector<double>& state) {
  if (!state.empty())
    throw std::invalid_argument("a rigid surface has no state, but the restart file holds one");
}

}  // namespace coupling
