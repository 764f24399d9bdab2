// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/model_text.h"
#include "coupling/open_structure.h"
#include "coupling/rigid_surface.h"
#include "geometry_io/geometry_io.h"

namespace coupling {

OpenedStructure open_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   RigidDrive drive) {
  const nurbs::GeometryFile file = geometry_io::read_geometry(path, reader_on_all_ranks(comm));
  std::vector<nurbs::Surface> patches;
  std::vector<int> outward_sign;
  for (nurbs::OrientedSurface& patch : nurbs::named_surface(file, surface, path)) {
    patches.push_back(std::move(patch.surface));
    outward_sign.push_back(patch.outward_sign);
  }
  auto solver = std::make_unique<RigidSurface>(patches, std::move(outward_sign));
  solver->drive(std::move(drive));
  return {std::move(solver), file.units};
}

}  // namespace coupling
