// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "coupling/model_text.h"
#include "coupling/open_structure.h"
#include "coupling/rigid/rigid_surface.h"
#include "geometry_io/geometry_io.h"
#include "nurbs/memory.h"
#include "nurbs/usable_number.h"
#include "parallel/all_or_none.h"

namespace coupling {

namespace {

// What contact keeps of each element, whether particles come near or not.
void expect_room(const std::vector<nurbs::Surface>& patches, const std::string& path) {
  constexpr double kBytesPerElement = 450.0;
  double elements = 0.0;
  for (const nurbs::Surface& patch : patches) elements += patch.space.element_count();
  try {
    nurbs::expect_memory(kBytesPerElement * elements, fmt::format("a wall of {:.3g} elements", elements));
  } catch (const std::invalid_argument& error) {
    throw geometry_io::InputError(fmt::format("{}: {}", path, error.what()));
  }
}

void expect_usable(const nurbs::Surface& patch, const std::string& path) {
  const double largest = patch.control_points.cwiseAbs().maxCoeff();
  if (!nurbs::is_usable(largest))
    throw geometry_io::InputError(fmt::format(
        "{}: scaled and moved as the deck says it has a coordinate of size {:.6g}, expected at most {}", path,
        largest, nurbs::kLargestNumber));
}

OpenedStructure read_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   const std::optional<geometry_io::Placement>& placement) {
  const geometry_io::GeometryFile file = geometry_io::read_geometry(path, reader_on_all_ranks(comm));
  std::vector<nurbs::Surface> patches;
  std::vector<int> outward_sign;
  for (geometry_io::OrientedSurface& patch : geometry_io::named_surface(file, surface, path)) {
    if (placement) {
      geometry_io::place(patch.surface.control_points, *placement);
      expect_usable(patch.surface, path);
    }
    patches.push_back(std::move(patch.surface));
    outward_sign.push_back(patch.outward_sign);
  }
  expect_room(patches, path);
  return {std::make_unique<RigidSurface>(patches, std::move(outward_sign)), file.units};
}

}  // namespace

OpenedStructure open_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   RigidDrive drive, const std::optional<geometry_io::Placement>& placement) {
  OpenedStructure opened =
      parallel::on_every_rank(comm, path, [&] { return read_rigid_surface(comm, path, surface, placement); });
  static_cast<RigidSurface&>(*opened.solver).drive(std::move(drive));
  return opened;
}

}  // namespace coupling
