// SPDX-License-Identifier: GPL-2.0-or-later
// For the test program liggghts-nurbs-late: every `structure` has a surface that is LATE_STEPS steps late.
// The product's function is compiled here under another name, and the linker takes ours in its place.
#define open_iga_structure open_iga_structure_in_phase
#include "coupling/open_iga_structure.cpp"
#undef open_iga_structure

#include <cstdlib>

#include "../../coupling/late_surface.h"

namespace coupling {

OpenedStructure open_iga_structure(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   const SolidOptions& options) {
  const char* const steps = std::getenv("LATE_STEPS");
  if (!steps) throw std::invalid_argument("LATE_STEPS is not set, expected a number of steps");
  OpenedStructure opened = open_iga_structure_in_phase(comm, path, surface, options);
  opened.solver = std::make_unique<test::LateSurface>(std::move(opened.solver), std::atoi(steps));
  return opened;
}

}  // namespace coupling
