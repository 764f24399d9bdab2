// SPDX-License-Identifier: GPL-2.0-or-later
// A motion in time, on one rank or several: what iga-solve does with a model without `analysis`.
#pragma once

#include <optional>
#include <stdexcept>
#include <utility>

#include "io/model_file.h"
#include "solve_options.h"
#include "structure/time/explicit_solver.h"

namespace app {

/// Time steps from the solver's time to the end.
struct Steps {
  long count;
  double size;       ///< [time]
  double next_size;  ///< of a run that goes on from the end: longer, if there was no room for a whole step
};

/// The model's, or the command line's; nothing if neither has one.
std::optional<double> end_of(const SolveOptions& options, const io::ModelFile& model);

/// The state that `time: {save: FILE}` has left, for a run that goes on from it.  Collective; throws
/// std::runtime_error.
io::SavedState read_saved(const io::ModelFile& model);
/// Puts the solver there, and warns where the model has changed since.  Collective; throws std::runtime_error
/// if it has so that no run can go on.
io::SavedState::Moment go_on(const io::SavedState& saved, const io::ModelFile& model,
                             structure::ExplicitSolver& solver);
void print_continued(const io::ModelFile& model, double time);

/// None longer than asked for, and the last one ends at `end` [time].  A run that is `continued` keeps the
/// time step of then, if the rest is a whole number of these and nothing else is asked for.  Throws
/// std::runtime_error if the step that is asked for is above the stable one.
Steps steps_to(double end, const SolveOptions& options, const io::ModelFile& model, double stable,
               const std::optional<io::SavedState::Moment>& continued);

/// The time step that the command line asks for, else the model, else 0.9 of the stable one.  Throws
/// std::runtime_error, without the model's name, if that is above the stable one or no node can move.
double longest_step(const SolveOptions& options, const io::ModelFile& model, double stable);

/// The stable step, which takes 20 internal forces; printed.  Collective.
double find_stable_step(const io::ModelFile& model, structure::ExplicitSolver& solver, Talk talk);

/// Runs, prints, writes what the model asks for.  Collective; throws std::runtime_error.
void run_in_time(const SolveOptions& options, io::ModelFile& model);

/// What action() returns; an error names the file.
template <class Action>
auto with_name(const io::ModelFile& model, Action action) try {
  return action();
} catch (const std::bad_alloc&) {
  throw;  // run_command names it
} catch (const std::exception& problem) {
  throw std::runtime_error(model.file + ": " + problem.what());
}

}  // namespace app
