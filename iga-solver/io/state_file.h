// SPDX-License-Identifier: GPL-2.0-or-later
// The state of a solid as a file (HDF5): what an analysis has found, and what a run or a deck starts from.
//   /                    attributes `format` ("iga-solver state"), `version` (1), `units`
//   /state/reference     [nodes][3] undeformed positions of the control points: a state belongs to one mesh
//   /state/displacement  [nodes][3],  /state/velocity [nodes][3],  /state/memory [numbers], if any
//   /state/time, /state/time_step [1], /state/work [numbers], of a motion that may be continued
//   /state/momentum      [nodes][3], of one that is damped by the mass, if that is corrected
//   /state/splines       [numbers] that the patches have beside control points; older files have none
//   /state/settings      texts: names and values, in turn, of what the model said beside the mesh; older
//                        files have none
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry_io/geometry_io.h"
#include "geometry_io/yaml_map.h"
#include "io/settings.h"
#include "structure/time/explicit_solver.h"

namespace io {

/// Of a whole solid, in the order of ids.
struct SavedState {
  std::string file;  ///< for messages
  nurbs::NodalVectors reference, displacement, velocity;
  std::vector<double> memory;
  /// Of a motion: when it was saved, the time step to go on with [time], and what forces had done
  /// (ExplicitSolver's save_work_done); its momenta_in_order().
  struct Moment {
    double time, step;
    std::vector<double> work, momentum;
  };
  std::optional<Moment> moment = {};
  Settings settings = {};           ///< of the model of then, if the file tells
  std::string discretisation = {};  ///< Body's: of other points the memory is; likewise
  /// Of each patch the degree and the knots of each direction, from 0 to 1, and weights where one is not 1;
  /// likewise.
  std::vector<double> splines = {};
};

/// Throws std::runtime_error, naming the file, if it cannot be written.
void write_state(const std::string& path, geometry_io::Units units, const SavedState& state);
/// Throws geometry_io::InputError, naming the file, if it is no such file or its units are others.
SavedState read_state(const std::string& path, geometry_io::Units units, const geometry_io::ReadFile& read);
/// The file that the key `state` of a model file names, relative to that.
SavedState read_state(const geometry_io::YamlMap& document, geometry_io::Units units,
                      const geometry_io::ReadFile& read);

/// Displacements u of a solver's nodes, at rest; the solver is of a whole body.
void put_at_rest(structure::ExplicitSolver& solver, const nurbs::NodalVectors& u, double time);

/// The solver's own.  Collective.
SavedState state_of(const structure::ExplicitSolver& solver);
/// The same in a motion, to be continued.
SavedState moment_of(const structure::ExplicitSolver& solver);
/// The solver goes on from there, at time 0; loads and supports are its own.  Viscosity that has nothing to
/// remember of its points, or of those of another quadrature, begins at rest.  Throws geometry_io::InputError
/// if the state is of another mesh, or of a law with another memory.  Collective.
void start_from(const SavedState& state, structure::ExplicitSolver& solver);
/// The same at the time of the state: with the same time step, and after initialise_forces the work of then,
/// the motion is that of a run that was not interrupted, to the last bit, cut in any way.  Also throws if the
/// state is not one of a motion.
void continue_from(const SavedState& state, structure::ExplicitSolver& solver);

}  // namespace io
