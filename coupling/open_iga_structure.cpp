// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/iga_structure.h"
#include "coupling/model_text.h"
#include "coupling/open_structure.h"
#include "io/model_file.h"

namespace coupling {

OpenedStructure open_iga_structure(MPI_Comm comm, const std::string& path, const std::string& surface) {
  const io::ModelFile model = io::parse_model_file(read_text_on_all_ranks(comm, path), path);
  nurbs::named_surface(model.geometry, surface, path);  // complains about a name that is not there
  const nurbs::Face face = *model.geometry.surfaces.at(surface);
  return {
      std::make_unique<IgaStructure>(io::build_solver(model), std::vector<nurbs::Face>{face}, model.probes),
      model.geometry.units};
}

}  // namespace coupling
