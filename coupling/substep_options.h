// SPDX-License-Identifier: GPL-2.0-or-later
// What a deck says of sub-steps (substeps.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "coupling/structure_solver.h"

namespace coupling {

constexpr int kMostSubsteps = 1000;

struct SubstepOptions {
  /// Whose steps are the short ones; by_time_step: the structure's if the particles' step is above its stable
  /// one.
  enum class Fast { by_time_step, particles, structure };
  Fast fast = Fast::by_time_step;
  std::optional<int>
      count;  ///< nothing: `auto`, as many as two_masses.h allows, or as the stable step asks for
  /// Largest mass of a particle [mass], 0 without particles; collective.  For `auto`, at the start of runs.
  std::function<double()> heaviest_particle = [] { return 0.0; };
};

/// Throws std::invalid_argument unless the solver is one of ours that deforms, or takes them by itself.
std::unique_ptr<StructureSolver> with_substeps(std::unique_ptr<StructureSolver> solver,
                                               SubstepOptions options);

}  // namespace coupling
