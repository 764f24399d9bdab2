// SPDX-License-Identifier: GPL-2.0-or-later
#include "stl_output.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "nurbs/memory.h"
#include "parallel/all_or_none.h"
#include "vtk/stl_file.h"

namespace liggghts_pkg {

StlOutput::StlOutput(MPI_Comm comm, StlOptions options, const WallTriangles& triangles)
    : comm_(comm), options_(std::move(options)), triangles_(triangles) {
  if (options_.chord) triangles_.keep_within(*options_.chord);
  constexpr double kBytesPerTriangle = 100.0;
  const double count = triangles_.count();
  parallel::on_every_rank(comm, options_.file, [&] {
    nurbs::expect_memory(kBytesPerTriangle * count, fmt::format("stl of {:.3g} triangles", count));
    return true;
  });
}

void StlOutput::write(long step) {
  parallel::on_first_rank(comm_, [&] {
    vtk::write_stl(fmt::format("{}_{}.stl", options_.file, step),
                   std::filesystem::path(options_.file).filename().string(), triangles_.in_space());
  });
  written_ = step;
}

}  // namespace liggghts_pkg
