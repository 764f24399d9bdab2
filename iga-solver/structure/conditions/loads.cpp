// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/conditions/loads.h"

#include "nurbs/control_area.h"

namespace structure {

NodalVectors gravity_load(const Body& body, const Vector3& g) { return g * body.row_sum_mass().transpose(); }

NodalVectors traction_load(const Body& body, const SkinPiece& piece, const Vector3& traction) {
  const nurbs::BoundarySurface boundary = body.skin(piece);
  const Eigen::VectorXd area = nurbs::control_point_areas(
      boundary.space, body.whole_reference()(Eigen::all, boundary.volume_control_point));
  NodalVectors f = NodalVectors::Zero(3, body.whole_reference().cols());
  f(Eigen::all, boundary.volume_control_point) = traction * area.transpose();
  return f;
}

}  // namespace structure
