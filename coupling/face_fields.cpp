// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/face_fields.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "brep/builder.h"
#include "brep/face_shape.h"
#include "brep/facets.h"
#include "brep/piece_distance.h"

namespace coupling {
namespace {

std::shared_ptr<const brep::Surface> in_triangles(std::shared_ptr<const brep::Surface> wall) {
  if (!wall->trimmed()) return wall;
  const nurbs::TriangleMesh mesh = brep::triangles_of(*wall, brep::kFacetChord * wall->size);
  std::vector<int> corners;
  for (const std::array<int, 3>& triangle : mesh.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  return std::make_shared<const brep::Surface>(brep::from_triangles(mesh.vertices, corners));
}

}  // namespace

FaceFields::FaceFields(MPI_Comm comm, const std::shared_ptr<const brep::Surface>& surface)
    : FaceFields(comm, surface, in_triangles(surface)) {}

FaceFields::FaceFields(MPI_Comm comm, std::shared_ptr<const brep::Surface> surface,
                       std::shared_ptr<const brep::Surface> triangles)
    : ContactFields(comm, static_cast<int>(triangles->pieces.size()),
                    static_cast<int>(triangles->pieces.size())),
      wall_(std::move(surface)),
      surface_(std::move(triangles)),
      area_(static_cast<Eigen::Index>(surface_->pieces.size())) {
  if (wall_ == surface_)
    in_plane_.emplace(*surface_);
  else
    tree_.emplace(*surface_);
  for (Eigen::Index k = 0; k < area_.size(); ++k) {
    const auto corner = [&](int i) { return surface_->vertices[surface_->pieces[k].vertex[i]].point; };
    area_[k] = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
}

// Triangles are within a chord of the wall.
int FaceFields::nearest_piece(const Vector3& point) {
  near_.clear();
  for (double reach = 2.0 * brep::kFacetChord * wall_->size; near_.empty(); reach *= 2.0)
    tree_->near(tree_->query(point, reach), near_);
  return *std::min_element(near_.begin(), near_.end(), [&](int a, int b) {
    return std::make_pair(brep::distance_of_piece(*surface_, a, point), a) <
           std::make_pair(brep::distance_of_piece(*surface_, b, point), b);
  });
}

int FaceFields::piece_at(const nurbs::SurfacePoint& foot) {
  const int piece = in_plane_ ? in_plane_->at(foot.patch, foot.xi)
                              : nearest_piece(brep::point_on(*wall_, foot.patch, foot.xi));
  if (piece < 0)
    throw std::logic_error("a contact on face " + std::to_string(foot.patch) +
                           " is in none of its triangles");
  return piece;
}

void FaceFields::add(const SurfaceContact& contact) {
  const int piece = piece_at(contact.foot);
  add_at(piece, rows_of(contact));
  count_in(piece);
}

ContactFields::State FaceFields::state(const NodalVectors& /*control_points*/, const RigidFrame& frame,
                                       const Selection& selection) {
  Eigen::MatrixXd per_area = all_forces();
  for (Eigen::Index k = 0; k < area_.size(); ++k)
    if (area_[k] > 0.0) per_area.col(k) /= area_[k];
  vtk::TriangleFields fields{brep::triangles_of(*surface_), fields_of_places(per_area, frame, selection)};
  for (vtk::Field& field : fields_of_cells(all_contacts(), selection))
    fields.cells.push_back(std::move(field));
  fields.mesh.vertices = frame.all_to_space(fields.mesh.vertices);
  return fields;
}

}  // namespace coupling
