// SPDX-License-Identifier: GPL-2.0-or-later
#include "triangle_twin.h"

#include <fmt/format.h>

#include "nurbs/memory.h"
#include "parallel/all_or_none.h"

namespace liggghts_pkg {

nurbs::TriangleMesh triangles_in_space(const nurbs::MultiPatch& surface,
                                       const nurbs::NodalVectors& control_points,
                                       const coupling::RigidFrame& frame, int cells) {
  nurbs::TriangleMesh mesh = nurbs::tessellate(nurbs::split(surface, control_points), cells);
  mesh.vertices = (frame.rotation * mesh.vertices).colwise() + frame.origin;
  return mesh;
}

void TriangleTwin::build(MPI_Comm comm, const std::string& file, const nurbs::MultiPatch& surface,
                         const nurbs::NodalVectors& control_points, const coupling::RigidFrame& frame,
                         int cells) {
  // LIGGGHTS keeps more than a kilobyte of each triangle, on every rank; one may have less memory than
  // another.
  constexpr double kBytesPerTriangle = 1500.0;
  const double triangles = 2.0 * cells * cells * surface.element_count();
  parallel::on_every_rank(comm, file, [&] {
    nurbs::expect_memory(kBytesPerTriangle * triangles,
                         fmt::format("twin {} of a wall of {} elements: {:.3g} triangles", cells,
                                     surface.element_count(), triangles));
    return true;
  });
  mesh_ = triangles_in_space(surface, control_points, frame, cells);
}

}  // namespace liggghts_pkg
