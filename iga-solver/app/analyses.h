// SPDX-License-Identifier: GPL-2.0-or-later
// What iga-solve does with `analysis` of a model file; on one rank.
#pragma once

#include <optional>

#include "io/field_series.h"
#include "io/model_file.h"
#include "solve_options.h"

namespace app {

/// `fields` are those of `output`, if it has some.  `solver` is the model's, and is left in the state that
/// was found.  Writes what `output` and the analysis ask for, and prints it as `options` say.  Throws
/// std::runtime_error.
void run_analysis(const SolveOptions& options, const io::ModelFile& model,
                  std::optional<io::FieldSeries>& fields, structure::ExplicitSolver& solver);

/// Throws structure::Diverged if a condition of the equilibrium that is looked for is not finite.
void expect_finite_conditions(const io::ModelFile& model, const structure::ExplicitSolver& solver);

}  // namespace app
