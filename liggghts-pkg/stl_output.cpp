// SPDX-License-Identifier: GPL-2.0-or-later
#include "stl_output.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "nurbs/memory.h"
#include "parallel/all_or_none.h"
#include "triangle_twin.h"
#include "vtk/stl_file.h"

namespace liggghts_pkg {

StlOutput::StlOutput(MPI_Comm comm, StlOptions options, const nurbs::MultiPatch& surface,
                     const nurbs::NodalVectors& control_points, int cells)
    : comm_(comm), options_(std::move(options)), cells_(cells) {
  if (options_.chord) cells_ = nurbs::cells_within(nurbs::split(surface, control_points), *options_.chord);
  constexpr double kBytesPerTriangle = 100.0;
  const double triangles = 2.0 * cells_ * cells_ * surface.element_count();
  nurbs::expect_memory(kBytesPerTriangle * triangles, fmt::format("stl of {:.3g} triangles", triangles));
}

void StlOutput::write(long step, const nurbs::MultiPatch& surface, const nurbs::NodalVectors& control_points,
                      const coupling::RigidFrame& frame) {
  parallel::on_first_rank(comm_, [&] {
    vtk::write_stl(fmt::format("{}_{}.stl", options_.file, step),
                   std::filesystem::path(options_.file).filename().string(),
                   triangles_in_space(surface, control_points, frame, cells_));
  });
  at_beginning_ = false;
}

}  // namespace liggghts_pkg
