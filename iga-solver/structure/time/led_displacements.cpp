// SPDX-License-Identifier: GPL-2.0-or-later
// What damps sub-steps (coupling/substeps.h): internal forces are those of where the body comes to be.
#include "structure/time/explicit_solver.h"
#include "structure/time/spin.h"

namespace structure {

void ExplicitSolver::set_lead(double lead) {
  lead_ = lead;
  turns_freely_ = lead > 0.0 && !halo_->any(!supports_.fixed_dofs().empty() || !springs_.empty());
  follow_spin();
}

void ExplicitSolver::follow_spin() {
  led_spin_.setZero();
  if (turns_freely_) led_spin_ = spin(x_, v_, mass_->nodal_mass(), *halo_);
}

const NodalVectors& ExplicitSolver::led_displacements() {
  if (lead_ == 0.0) return u_;
  led_u_ = u_ + lead_ * v_;
  if (!led_spin_.isZero(0.0)) {
    const Eigen::Matrix3d turn = (Eigen::Matrix3d() << 0.0, -led_spin_[2], led_spin_[1], led_spin_[2], 0.0,
                                  -led_spin_[0], -led_spin_[1], led_spin_[0], 0.0)
                                     .finished();
    led_u_.noalias() -= (lead_ * turn) * x_;
  }
  return led_u_;
}

}  // namespace structure
