// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_triangles.h"

#include <fmt/format.h>

#include "brep/triangle_mesh.h"

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
  return surface.faces ? brep::triangles_of(*surface.faces)
                       : nurbs::tessellate(nurbs::split(surface.topology, exchange_.positions()), cells);
}

nurbs::TriangleMesh WallTriangles::in_space(int cells) const {
  nurbs::TriangleMesh mesh = in_body(cells);
  const coupling::RigidFrame frame = structure_.frame();
  mesh.vertices = (frame.rotation * mesh.vertices).colwise() + frame.origin;
  return mesh;
}

}  // namespace liggghts_pkg
