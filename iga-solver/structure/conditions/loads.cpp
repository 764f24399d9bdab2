// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/loads.h"

#include "nurbs/control_area.h"

namespace structure {

NodalVectors gravity_load(const Solid& solid, const Vector3& g) {
  return g * solid.row_sum_mass().transpose();
}

NodalVectors traction_load(const nurbs::Volume& patch, nurbs::Face face, const Vector3& traction) {
  const nurbs::BoundarySurface boundary = nurbs::boundary_surface(patch.space, face);
  const Eigen::VectorXd area = nurbs::control_point_areas(
      boundary.space, patch.control_points(Eigen::all, boundary.volume_control_point));
  NodalVectors f = NodalVectors::Zero(3, patch.control_points.cols());
  f(Eigen::all, boundary.volume_control_point) = traction * area.transpose();
  return f;
}

}  // namespace structure
