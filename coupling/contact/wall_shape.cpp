// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/wall_shape.h"

#include <algorithm>

#include "brep/face_shape.h"
#include "coupling/contact/contact_tracker.h"
#include "coupling/contact/face_follower.h"
#include "nurbs/surface_normal.h"

namespace contact {

using nurbs::SurfaceShape;
using nurbs::Vector3;
using search::Foot;

void PatchShape::changed() { projector_.surface_moved(); }

void PatchShape::begin_list(bool moved) {
  if (!moved && !tree_.empty()) return;
  tree_.build(surface_, control_points_);
  projector_.begin_list(edge_angle_);
}

std::unique_ptr<FeetTracker> PatchShape::track(const CandidateList& candidates, SearchMethod method,
                                               SearchCounts& counts) const {
  return std::make_unique<ContactTracker>(LocalSearch(method, projector_, counts), candidates, edge_angle_);
}

Vector3 PatchShape::normal_at(const Foot& foot) const {
  return foot.status == search::FootStatus::interior
             ? nurbs::shape_at(surface_, control_points_, foot.at()).normal
             : nurbs::normal_at(surface_, control_points_, foot.at());
}

SurfaceShape PatchShape::shape_near(const Foot& foot) const {
  return nurbs::shape_near(surface_.patch(foot.patch),
                           surface_.control_points_of(foot.patch, control_points_), foot.xi);
}

std::unique_ptr<FeetTracker> FacedPatchShape::track(const CandidateList& candidates, SearchMethod /*method*/,
                                                    SearchCounts& counts) const {
  const FaceNames names(charts_, parts_);
  if (charts_.empty()) return std::make_unique<FaceFollower>(search_, names, candidates, counts);
  return std::make_unique<FaceTracker>(search_, names, candidates, counts);
}

Vector3 FacedPatchShape::normal_at(const Foot& foot) const {
  if (!is_on_closed_form(foot)) return nurbs::normal_at(surface_, control_points_, foot.at());
  return shape_near(foot).normal;
}

SurfaceShape FacedPatchShape::shape_near(const Foot& foot) const {
  if (!is_on_closed_form(foot))
    return nurbs::shape_near(surface_.patch(foot.patch),
                             surface_.control_points_of(foot.patch, control_points_), foot.xi);
  const int part = parts_.part_at(foot.at());
  const brep::Chart& chart = charts_[part];
  const brep::Face& face = search_.surface().faces[part];
  const brep::Parameter<2> xi = chart.to_face(foot.xi), of_face = face.curvatures(xi);
  const double k[2] = {chart.side * of_face[0], chart.side * of_face[1]};
  return {foot.point, chart.side * face.normal(xi), {std::min(k[0], k[1]), std::max(k[0], k[1])}};
}

std::unique_ptr<FeetTracker> FaceShape::track(const CandidateList& candidates, SearchMethod /*method*/,
                                              SearchCounts& counts) const {
  if (search_.surface().patches)
    return std::make_unique<FaceFollower>(search_, FaceNames(), candidates, counts);
  return std::make_unique<FaceTracker>(search_, FaceNames(), candidates, counts);
}

Vector3 FaceShape::normal_at(const Foot& foot) const {
  return brep::normal_on(search_.surface(), foot.patch, foot.xi);
}

SurfaceShape FaceShape::shape_near(const Foot& foot) const {
  SurfaceShape shape = brep::shape_on(search_.surface(), foot.patch, foot.xi);
  shape.point = foot.point;
  return shape;
}

}  // namespace contact
