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

namespace {

/// Of an element, enough to know a patch of this degree by.
template <class ControlPoints>
void points_on(const nurbs::Space<2>& space, const ControlPoints& control_points, int element,
               std::vector<Vector3>& points) {
  const nurbs::Indices<2> at = space.element_indices(element);
  int count[2];
  for (int d = 0; d < 2; ++d) count[d] = space.knots(d).degree() + 2;
  for (int j = 0; j < count[1]; ++j)
    for (int i = 0; i < count[0]; ++i) {
      nurbs::Parameter<2> xi;
      for (const auto& [d, k] : {std::pair{0, i}, std::pair{1, j}}) {
        const double low = space.knots(d).breaks()[at[d]], high = space.knots(d).breaks()[at[d] + 1];
        xi[d] = low + (high - low) * k / (count[d] - 1);
      }
      points.push_back(nurbs::interpolate(space, control_points, xi));
    }
}

}  // namespace

void PatchShape::points_of(int element, std::vector<Vector3>& points) const {
  points.clear();
  const int p = surface_.patch_of_element(element);
  points_on(projector_.patch(p).space(), projector_.patch(p).control_points(),
            element - surface_.first_element(p), points);
}

// Of trimmed faces, borders and what lies between them do not go by pieces.
void ShapeOnFaces::points_of(int piece, std::vector<Vector3>& points) const {
  points.clear();
  const brep::Surface& surface = search_.surface();
  const brep::Piece& of = surface.pieces[piece];
  if (of.triangle()) {
    for (const int vertex : of.vertex) points.push_back(surface.vertices[vertex].point);
  } else if (of.kind == brep::Piece::Kind::element) {
    const nurbs::Surface& patch = surface.patches->patch(surface.faces[of.face].patch);
    points_on(patch.space, patch.control_points, of.element(), points);
  }
}

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
