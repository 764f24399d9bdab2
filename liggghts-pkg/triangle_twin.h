// SPDX-License-Identifier: GPL-2.0-or-later
// The wall in triangles; fix mesh/surface ... fix ID takes it as it stands when that fix is created.
#ifndef LMP_TRIANGLE_TWIN_H
#define LMP_TRIANGLE_TWIN_H

#include <mpi.h>

#include <string>

#include "wall_triangles.h"

namespace liggghts_pkg {

class TriangleTwin {
 public:
  /// Collective; `cells` per element and direction of a wall of patches.  Throws std::runtime_error if
  /// LIGGGHTS has no memory for so many; `file`: of the wall, for the message.
  void build(MPI_Comm comm, const std::string& file, const WallTriangles& triangles);

  int triangle_count() const { return static_cast<int>(mesh_.triangles.size()); }
  /// Three numbers of corner i, three corners to a triangle.
  double* corner(int i) { return mesh_.vertices.col(mesh_.triangles[i / 3][i % 3]).data(); }

 private:
  nurbs::TriangleMesh mesh_;
};

}  // namespace liggghts_pkg

#endif
