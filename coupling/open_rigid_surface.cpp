// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/model_text.h"
#include "coupling/open_structure.h"
#include "coupling/rigid_surface.h"

namespace coupling {

OpenedStructure open_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface) {
  const nurbs::GeometryFile file = nurbs::parse_geometry_file(read_text_on_all_ranks(comm, path), path);
  nurbs::NamedSurface named = nurbs::named_surface(file, surface, path);
  return {std::make_unique<RigidSurface>(std::vector<nurbs::Surface>{std::move(named.surface)},
                                         std::vector<int>{named.outward_sign}),
          file.units};
}

}  // namespace coupling
