// SPDX-License-Identifier: GPL-2.0-or-later
// `iga-solve --check`: what a run would be, without running it.
#pragma once

#include "io/model_file.h"
#include "solve_options.h"

namespace app {

/// Prints size, mass, stable step, steps, an estimate of the time that they take, memory, output, and what
/// looks like a slip.  Collective.  Throws std::runtime_error where a run would refuse the model.
void check_model(const SolveOptions& options, io::ModelFile& model);

/// Throws std::runtime_error if the state that the model is to save cannot be written.  Collective.
void check_save(const io::ModelFile& model);

}  // namespace app
