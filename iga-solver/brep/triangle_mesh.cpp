// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/triangle_mesh.h"

namespace brep {

nurbs::TriangleMesh triangles_of(const Surface& surface) {
  nurbs::TriangleMesh mesh;
  mesh.vertices.resize(3, static_cast<Eigen::Index>(surface.vertices.size()));
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    mesh.vertices.col(static_cast<Eigen::Index>(v)) = surface.vertices[v].point;
  for (const Piece& piece : surface.pieces)
    mesh.triangles.push_back({piece.vertex[0], piece.vertex[1], piece.vertex[2]});
  return mesh;
}

}  // namespace brep
