// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_triangles.h"

#include <fmt/format.h>

#include "brep/facets.h"

namespace liggghts_pkg {

WallTriangles::WallTriangles(const coupling::StructureSolver& structure,
                             const coupling::SurfaceExchange& exchange, int cells)
    : structure_(structure), exchange_(exchange), cells_(cells) {
  constexpr double kCells = 2.0;  // of which the chord is the usual one
  if (const auto& faces = structure.surface().faces)
    chord_ = brep::kFacetChord * faces->size * kCells * kCells / (cells * cells);
}

void WallTriangles::keep_within(double chord) {
  const coupling::ContactSurface& surface = structure_.surface();
  chord_ = chord;
  if (!surface.faces)
    cells_ = nurbs::cells_within(nurbs::split(surface.topology, exchange_.body_positions()), chord);
}

double WallTriangles::count() const {
  const coupling::ContactSurface& surface = structure_.surface();
  if (!surface.faces) return 2.0 * cells_ * cells_ * surface.topology.element_count();
  return surface.faces->trimmed() ? static_cast<double>(in_body().triangles.size())
                                  : static_cast<double>(surface.faces->pieces.size());
}

std::string WallTriangles::of_what() const {
  const coupling::ContactSurface& surface = structure_.surface();
  if (!surface.faces) return fmt::format("a wall of {} elements", surface.topology.element_count());
  return surface.faces->trimmed() ? fmt::format("a wall of {} faces", surface.faces->faces.size())
                                  : fmt::format("a wall of {} triangles", surface.faces->pieces.size());
}

nurbs::TriangleMesh WallTriangles::in_body() const {
  const coupling::ContactSurface& surface = structure_.surface();
  return surface.faces
             ? brep::triangles_of(*surface.faces, chord_)
             : nurbs::tessellate(nurbs::split(surface.topology, exchange_.body_positions()), cells_);
}

nurbs::TriangleMesh WallTriangles::in_space() const {
  nurbs::TriangleMesh mesh = in_body();
  const coupling::RigidFrame frame = structure_.frame();
  mesh.vertices = frame.all_to_space(mesh.vertices);
  return mesh;
}

}  // namespace liggghts_pkg
