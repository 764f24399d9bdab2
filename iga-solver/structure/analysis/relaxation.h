// SPDX-License-Identifier: GPL-2.0-or-later
// To rest in time: where the kinetic energy has passed a peak, the body goes back to where it was then and
// velocities are set to zero; so it drains, whatever the body and its law. Without the way back a mode with
// omega dt = sqrt(2) or sqrt(3), which is at rest again after two or three steps, would go on for ever. With
// it no peak takes less than the first step from rest has: sin^2(theta) of each mode's energy, cos(theta) =
// 1 - (omega dt)^2/2, which is 0 for none below the stable step.
// Source: Cundall (1976); Day (1965), Engineer 219, 218-221; Underwood (1983), "Dynamic relaxation", in
// Belytschko & Hughes (eds.), Computational Methods for Transient Analysis; the way back: Barnes (1999), Int.
// J. Space Struct. 14, 89-104, who puts the peak between two steps.
#pragma once

#include <functional>
#include <stdexcept>

#include "structure/time/explicit_solver.h"

namespace structure {

struct RelaxOptions {
  double tolerance = 1e-6;       ///< of the forces out of balance, relative to loads and reactions
  long most_steps = 10'000'000;  ///< time steps
  double conditions_time = 1.0;  ///< loads and supports are those of then, from the beginning
};

/// How it stands at a peak of the kinetic energy.
struct RelaxPeak {
  long step;
  double residual;  ///< forces out of balance, relative
};

/// From the solver's state to rest under its loads, with its time step, which is set; where strain brings the
/// stable step below it, with the same share of that from then on.  Gives the last peak.
/// Throws NoEquilibrium if the supports leave the body a rigid motion, std::runtime_error if it takes more
/// steps, Diverged as the solver.
RelaxPeak relax(ExplicitSolver& solver, const RelaxOptions& options,
                const std::function<void(const RelaxPeak&)>& on_peak = {});

}  // namespace structure
