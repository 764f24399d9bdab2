// SPDX-License-Identifier: GPL-2.0-or-later
// What a model is, in lines for people.  Everything here is collective where the solver is; rank 0 prints.
#pragma once

#include <string>
#include <vector>

#include "io/model_file.h"
#include "structure/time/explicit_solver.h"

namespace app {

/// Elements, degrees of freedom, mass.
void print_model(const io::ModelFile& model, const structure::ExplicitSolver& solver);
/// Laws and what is given to hold and load the solid.
void print_details(const io::ModelFile& model);
void print_energies(const structure::ExplicitSolver& solver);
/// What is doubtful about the last step, if anything is.
void print_warning(const io::ModelFile& model, structure::ExplicitSolver& solver);

/// What the rules allow but hardly anybody means, one line each; before a solver takes the control points.
/// `end`: of a motion in time, if it is known [time].
std::vector<std::string> warnings_of(const io::ModelFile& model, std::optional<double> end);

/// Those of them that a run tells, too.
std::vector<std::string> warnings_of_run(const io::ModelFile& model);

}  // namespace app
