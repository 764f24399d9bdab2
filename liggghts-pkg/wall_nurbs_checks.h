// SPDX-License-Identifier: GPL-2.0-or-later
// What fix wall/nurbs asks of the deck before each run, and of the run afterwards.  The checks throw
// std::invalid_argument: what was given, what was expected.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "coupling/contact/contact_loop.h"
#include "coupling/structure_solver.h"
#include "wall_nurbs_options.h"

namespace LAMMPS_NS {
class Modify;
class Update;
}  // namespace LAMMPS_NS

namespace liggghts_pkg {

/// That no other wall of the deck integrates this solid, or writes this output.  Collective.
void check_other_walls(const LAMMPS_NS::Modify& modify, MPI_Comm world, const WallNurbsOptions& options);

/// Velocity Verlet only: minimisation and respa do not call the fix as its time step needs.
void check_run_style(const LAMMPS_NS::Update& update);

/// The deck's Young's modulus and Poisson's ratio of the wall's type are those of the solid below the
/// surface, which then is of one material, within 1e-6, where the deck defines them and there is a solid.
void check_wall_material(LAMMPS_NS::Modify& modify, int wall_type,
                         const std::vector<coupling::SurfaceMaterial>& materials, const std::string& file);

/// Gives the solid the sum of the deck's gravities, if its file says so.  In setup, before its first forces.
/// Throws std::invalid_argument if one of them varies.
void give_gravity(const LAMMPS_NS::Modify& modify, coupling::StructureSolver& structure,
                  const std::string& file);

/// What to tell the user if `fix gravity` pulls at the particles, and nothing at the solid that they hit: the
/// line that its file lacks; or if the solid waits for one that is not there.  Empty if all is well.  In
/// setup: the deck's gravity is known only then.
std::string missing_gravity(const LAMMPS_NS::Modify& modify, const coupling::StructureSolver& structure,
                            const std::string& file);

/// What to tell the user of particles that came where they should not in this run of time steps `dt`.
/// Collective.
std::vector<std::string> alarms_of_run(const contact::ContactLoop& loop, double dt, MPI_Comm world);
/// The same of contacts and the solid's mesh: its elements are too small for what is not corrected, or too
/// large for a correction that is static.  Empty if all is well.  `can_be_corrected`: if the user asks for
/// it.
std::string alarm_of_mesh(const contact::ContactLoop& loop, bool can_be_corrected, MPI_Comm world);

}  // namespace liggghts_pkg
