// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/wall_size.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "brep/cad_model.h"

namespace geometry_io {
namespace {

const nurbs::NodalVectors& points_of(const TriangleMesh& mesh) { return mesh.points; }
template <int Dim>
const nurbs::NodalVectors& points_of(const nurbs::Patch<Dim>& patch) {
  return patch.control_points;
}

void extend(Eigen::AlignedBox3d& box, const nurbs::NodalVectors& points) {
  if (points.cols() == 0) return;
  box.extend(nurbs::Vector3(points.rowwise().minCoeff())).extend(nurbs::Vector3(points.rowwise().maxCoeff()));
}

// A whole sphere has two vertices, a whole torus one.
void extend(Eigen::AlignedBox3d& box, const brep::CadModel& model) {
  for (const brep::CadVertex& vertex : model.vertices) box.extend(vertex.point);
  for (const brep::CadFace& face : model.faces) {
    if (face.shape.kind == brep::Kind::plane || face.shape.kind == brep::Kind::nurbs) continue;
    const nurbs::Vector3 radius = nurbs::Vector3::Constant(face.shape.R);
    box.extend(face.shape.frame.origin - radius).extend(face.shape.frame.origin + radius);
  }
  for (const nurbs::Surface& patch : model.patches) extend(box, patch.control_points);
}

}  // namespace

nurbs::Vector3 extents_of(const std::vector<Shape>& patches, const brep::CadModel* cad) {
  Eigen::AlignedBox3d box;
  for (const Shape& shape : patches)
    std::visit([&](const auto& patch) { extend(box, points_of(patch)); }, shape);
  if (cad != nullptr) extend(box, *cad);
  return box.isEmpty() ? nurbs::Vector3(nurbs::Vector3::Zero()) : nurbs::Vector3(box.sizes());
}

std::string size_problem(const nurbs::Vector3& extents, const nurbs::Vector3& factors) {
  const double size = extents.cwiseProduct(factors).maxCoeff();
  if (extents.isZero(0.0) || (size >= kSmallestSize && size <= kLargestSize)) return "";
  return fmt::format("{:.6g} in size, expected {} to {}", size, kSmallestSize, kLargestSize);
}

}  // namespace geometry_io
