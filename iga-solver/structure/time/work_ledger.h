// SPDX-License-Identifier: GPL-2.0-or-later
// The work of nodal forces by the rule of velocity Verlet: a half kick by a force F, which takes v to v',
// does dt/2 F . (v + v')/2.  Summed so, kinetic energy + internal - loads - forces is constant to round-off,
// whatever the forces and the step: what is left over is energy that a force brought in unseen.
#pragma once

#include <array>

#include "structure/halo.h"

namespace structure {

/// [energy]
struct Work {
  /// Done against internal forces: the change of strain energy and what the material has dissipated, up to
  /// the error of the step.
  double internal = 0.0;
  double loads = 0.0;   ///< of the external loads
  double forces = 0.0;  ///< of somebody's forces (contact)
};

class WorkLedger {
 public:
  /// A half kick over dt/2, with twice the mean velocity, v + v'; nodal arrays (3 x held).  Fixed dofs have
  /// v = v' = 0.
  void half_kick(const Halo& halo, double half_step, const nurbs::NodalVectors& v_sum,
                 const nurbs::NodalVectors& f_int, const nurbs::NodalVectors& f_ext,
                 const nurbs::NodalVectors& F) {
    const nurbs::NodalVectors* const forces[] = {&f_int, &f_ext, &F};
    for (int i = 0; i < 3; ++i)
      halo.add_own(v_sum.cols(), sums_[i], [&](Eigen::Index first, Eigen::Index count) {
        return 0.5 * half_step *
               forces[i]->middleCols(first, count).cwiseProduct(v_sum.middleCols(first, count)).sum();
      });
  }
  /// Of all parts; collective.
  Work work(const Halo& halo) const {
    std::array<ExactSum, 3> all = sums_;
    halo.sum(all.data(), all.size());
    return {all[0].value(), all[1].value(), all[2].value()};
  }

 private:
  std::array<ExactSum, 3> sums_;  // internal, loads, forces
};

}  // namespace structure
