// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/patch_faces.h"

#include <utility>

namespace brep {

PatchFaces::PatchFaces(std::vector<nurbs::Surface> patches) : patches_(std::move(patches)) {
  for (const nurbs::Surface& patch : patches_) {
    nurbs::check_patch(patch);
    const search::PatchPoints points(patch.control_points, 0, patch.space.control_point_count());
    projectors_.push_back(std::make_unique<search::SurfaceProjector>(patch.space, points));
    boxes_.emplace_back();
    for (int e = 0; e < patch.space.element_count(); ++e)
      boxes_.back().push_back(search::element_box(patch.space, patch.control_points, e));
  }
}

Vector3 PatchFaces::point(int p, const Parameter<2>& xi) const {
  return nurbs::interpolate(patches_[p].space, patches_[p].control_points, xi);
}

nurbs::SurfaceShape PatchFaces::shape(int p, const Parameter<2>& xi) const {
  return nurbs::shape_near(patches_[p].space, patches_[p].control_points, xi);
}

Vector3 PatchFaces::tangent(int p, const Parameter<2>& xi, int i) const {
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(patches_[p].space, xi, 1, basis);
  Vector3 tangent = Vector3::Zero();
  for (int a = 0; a < basis.count; ++a)
    tangent += basis.dR[i][a] * patches_[p].control_points.col(basis.control_point[a]);
  return tangent;
}

bool PatchFaces::on_border(int p, const Parameter<2>& xi) const {
  for (int i = 0; i < 2; ++i) {
    const nurbs::KnotVector& knots = patches_[p].space.knots(i);
    if (xi[i] <= knots.front() || xi[i] >= knots.back()) return true;
  }
  return false;
}

}  // namespace brep
