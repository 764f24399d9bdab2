// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/rigid_surface.h"

#include <limits>
#include <stdexcept>

namespace coupling {

RigidSurface::RigidSurface(const std::vector<nurbs::Surface>& patches, std::vector<int> outward_sign)
    : RigidSurface(nurbs::join(patches), std::move(outward_sign)) {}

RigidSurface::RigidSurface(nurbs::PatchedSurface surface, std::vector<int> outward_sign)
    : surface_{std::move(surface.topology), SurfaceMap::identity(surface.control_points.cols()),
               std::move(outward_sign)},
      positions_(std::move(surface.control_points)),
      velocities_(NodalVectors::Zero(3, positions_.cols())) {
  surface_.outward_sign.resize(surface_.topology.patch_count(), 0);
}

double RigidSurface::stable_time_step() const { return std::numeric_limits<double>::infinity(); }

void RigidSurface::load(const std::vector<double>& state) {
  if (!state.empty())
    throw std::invalid_argument("a rigid surface has no state, but the restart file holds one");
}

}  // namespace coupling
