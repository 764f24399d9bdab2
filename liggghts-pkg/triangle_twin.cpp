// SPDX-License-Identifier: GPL-2.0-or-later
#include "triangle_twin.h"

#include <fmt/format.h>

#include "nurbs/memory.h"
#include "parallel/all_or_none.h"

namespace liggghts_pkg {

void TriangleTwin::build(MPI_Comm comm, const std::string& file, const WallTriangles& triangles) {
  // LIGGGHTS keeps more than a kilobyte of each triangle, on every rank; one may have less memory than
  // another.
  constexpr double kBytesPerTriangle = 1500.0;
  const double count = triangles.count();
  parallel::on_every_rank(comm, file, [&] {
    nurbs::expect_memory(
        kBytesPerTriangle * count,
        fmt::format("twin {} of {}: {:.3g} triangles", triangles.cells(), triangles.of_what(), count));
    return true;
  });
  mesh_ = triangles.in_space();
}

}  // namespace liggghts_pkg
