// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_triangles.h"

#include <fmt/format.h>

namespace liggghts_pkg {

double WallTriangles::count(int cells) const {
  const coupling::ContactSurface& surface = structure_.surface();
  return surface.faces ? static_cast<double>(surface.faces->pieces.size())
                       : 2.0 * cells * cells * surface.topology.element_count();
}

std::string WallTriangles::of_what() const {
  const coupling::ContactSurface& surface = structure_.surface();
  return surface.faces ? fmt::format("a wall of {} triangles", surface.faces->pieces.size())
                       : fmt::format("a wall of {} elements", surface.topology.element_count());
}

int WallTriangles::cells_within(double chord) const {
  const coupling::ContactSurface& surface = structure_.surface();
  return surface.faces ? 1
                       : nurbs::cells_within(nurbs::split(surface.topology, exchange_.positions()), chord);
}

nurbs::TriangleMesh WallTriangles::in_body(int cells) const {
  const coupling::ContactSurface& surface = structure_.surface();
  return surface.faces ? triangles_of(*surface.faces)
                       : nurbs::tessellate(nurbs::split(surface.topology, exchange_.positions()), cells);
}

nurbs::TriangleMesh WallTriangles::in_space(int cells) const {
  nurbs::TriangleMesh mesh = in_body(cells);
  const coupling::RigidFrame frame = structure_.frame();
  mesh.vertices = (frame.rotation * mesh.vertices).colwise() + frame.origin;
  return mesh;
}

nurbs::TriangleMesh triangles_of(const brep::Surface& faces) {
  nurbs::TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(faces.vertices.size()));
  for (std::size_t v = 0; v < faces.vertices.size(); ++v) mesh.vertices.col(v) = faces.vertices[v].point;
  for (const brep::Piece& piece : faces.pieces)
    mesh.triangles.push_back({piece.vertex[0], piece.vertex[1], piece.vertex[2]});
  return mesh;
}

}  // namespace liggghts_pkg
