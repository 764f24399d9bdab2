// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/face_fields.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "brep/builder.h"
#include "brep/face_shape.h"
#include "brep/facets.h"
#include "brep/piece_distance.h"

namespace coupling {
namespace {

// Whether the point is off all sides of the triangle, over it.
bool is_inside(const brep::Surface& surface, const brep::Piece& piece, const Vector3& point,
               const Vector3& normal) {
  for (int i = 0; i < 3; ++i) {
    const Vector3& from = surface.vertices[piece.vertex[i]].point;
    const Vector3 way = surface.vertices[piece.vertex[(i + 1) % 3]].point - from;
    if (!(normal.cross(way).dot(point - from) > 0.0)) return false;
  }
  return true;
}

// Of the point from the nearest side of the triangle, in the plane with this normal; negative outside.
double depth_in(const brep::Surface& surface, const brep::Piece& piece, const Vector3& point,
                const Vector3& normal) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector3& from = surface.vertices[piece.vertex[i]].point;
    const Vector3 way = surface.vertices[piece.vertex[(i + 1) % 3]].point - from;
    least = std::min(least, normal.cross(way).dot(point - from) / way.norm());
  }
  return least;
}

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
      tree_(*surface_),
      area_(static_cast<Eigen::Index>(surface_->pieces.size())) {
  near_.reserve(surface_->pieces.size());
  for (Eigen::Index k = 0; k < area_.size(); ++k) {
    const auto corner = [&](int i) { return surface_->vertices[surface_->pieces[k].vertex[i]].point; };
    area_[k] = 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
}

// Triangles are within a chord of the wall.
int FaceFields::nearest_piece(const Vector3& point) {
  near_.clear();
  for (double reach = 2.0 * brep::kFacetChord * wall_->size; near_.empty(); reach *= 2.0)
    tree_.near(tree_.query(point, reach), near_);
  return *std::min_element(near_.begin(), near_.end(), [&](int a, int b) {
    return std::make_pair(brep::distance_of_piece(*surface_, a, point), a) <
           std::make_pair(brep::distance_of_piece(*surface_, b, point), b);
  });
}

int FaceFields::piece_at(const nurbs::SurfacePoint& foot) {
  if (wall_ != surface_) return nearest_piece(brep::point_on(*wall_, foot.patch, foot.xi));
  const brep::Face& face = surface_->faces[foot.patch];
  const Vector3 point = face.point(foot.xi);
  constexpr double kUneven = 1e-5;  // of the size: triangles are in their face's plane to 1e-6 of it
  constexpr int kFew = 8;           // triangles of a face, which all are looked at
  near_.clear();
  if (face.piece_count > kFew)
    tree_.near(tree_.query(point, kUneven * surface_->size), near_);
  else
    for (int k = 0; k < face.piece_count; ++k) near_.push_back(face.first_piece + k);
  for (const int piece : near_)
    if (surface_->pieces[piece].face == foot.patch &&
        is_inside(*surface_, surface_->pieces[piece], point, face.frame.z))
      return piece;
  int found = -1;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const int piece : near_) {
    if (surface_->pieces[piece].face != foot.patch || area_[piece] == 0.0) continue;
    const double depth = depth_in(*surface_, surface_->pieces[piece], point, face.frame.z);
    if (depth < deepest || (depth == deepest && piece > found)) continue;
    deepest = depth;
    found = piece;
  }
  if (found < 0)
    throw std::logic_error("a contact on face " + std::to_string(foot.patch) +
                           " is in none of its triangles");
  return found;
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
