// SPDX-License-Identifier: GPL-2.0-or-later
// From a file named in a deck to the solver behind the port.  A new kind of structure is one more function
// here.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/rigid/rigid_surface.h"
#include "coupling/solid_options.h"
#include "coupling/structure_solver.h"
#include "geometry_io/geometry_file.h"
#include "geometry_io/placement.h"

namespace coupling {

/// What a deck's `structure` or `geometry` keyword opens.
struct OpenedStructure {
  std::unique_ptr<StructureSolver> solver;
  geometry_io::Units units;
  std::vector<std::string> warnings = {};  ///< of what is allowed and hardly meant, a sentence each
  std::string uncorrected = {};  ///< why contacts are not corrected, if the options leave it to the solid
};

struct RigidOptions {
  geometry_io::Units units = geometry_io::Units::si;  ///< of triangles, whose files have none
  std::optional<geometry_io::Placement> placement;    ///< where it is placed before it moves
  double edge_angle = brep::kEdgeAngle;  ///< edges between faces that turn by less are smooth [rad]
  bool faces = true;                     ///< feet on faces where brep::faced_patches has them
  std::string keep;                      ///< where what was read is written, unplaced, if not empty
};

/// Rigid wall: the named surface of a geometry file, and what moves it.  Collective; throws
/// geometry_io::InputError or std::invalid_argument on every rank.
OpenedStructure open_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   RigidDrive drive = {}, const RigidOptions& options = {});

/// Deforming solid of iga-solver: the named surface of a model file.  Collective; throws
/// geometry_io::InputError on every rank.  Lives in the library coupling_iga, so that a rigid wall links no
/// structural code.
OpenedStructure open_iga_structure(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   const SolidOptions& options = {});

/// A body of an outside code: `library` exports what plugin/structure_plugin.h asks for, `model` and
/// `surface` are its business.  Collective; throws std::invalid_argument or geometry_io::InputError on every
/// rank. Lives in the library coupling_plugin.
OpenedStructure open_plugin_structure(MPI_Comm comm, const std::string& library, const std::string& model,
                                      const std::string& surface);

}  // namespace coupling
