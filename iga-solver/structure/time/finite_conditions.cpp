// SPDX-License-Identifier: GPL-2.0-or-later
// What a model's expressions have to be: finite.
#include <fmt/format.h>

#include <cmath>

#include "structure/time/explicit_solver.h"

namespace structure {

std::string ExplicitSolver::load_not_finite(double t) const {
  NodalVectors f(3, u_.cols());
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    f.setZero();
    loads_[i]->add(t, body_->reference(), *halo_, f);
    if (halo_->any(!halo_->own(f).allFinite()))
      return fmt::format("the load {} is not finite at time {:.6g}, expected numbers", load_names_[i], t);
  }
  return {};
}

void ExplicitSolver::expect_finite_conditions(double t) const {
  for (const Motion& motion : supports_.motions())
    if (!std::isfinite(value_at(motion.time, t)))
      throw Diverged(fmt::format("the motion of a support is not finite at time {:.6g}", t));
  const std::string load = load_not_finite(t);
  if (!load.empty()) throw Diverged(load);
}

}  // namespace structure
