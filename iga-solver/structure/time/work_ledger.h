// SPDX-License-Identifier: GPL-2.0-or-later
// The work of nodal forces by the rule of velocity Verlet: a half kick by a force F, which takes v to v',
// does dt/2 F . (v + v')/2.  Summed so, kinetic energy + internal - loads - forces is constant to round-off,
// whatever the forces and the step: what is left over is energy that a force brought in unseen.
#pragma once

#include <cmath>

#include "nurbs/types.h"

namespace structure {

/// [energy]
struct Work {
  /// Done against internal forces: the change of strain energy and what the material has dissipated, up to
  /// the error of the step.
  double internal = 0.0;
  double loads = 0.0;   ///< of the external loads
  double forces = 0.0;  ///< of somebody's forces (contact)
};

/// A sum that keeps its round-off, for millions of terms (Neumaier 1974, Z. angew. Math. Mech. 54, 39).
class CompensatedSum {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

class WorkLedger {
 public:
  /// dt/2 and twice the mean velocity v + v' of a half kick; fixed dofs have v = v' = 0.  Nodal arrays, or
  /// whole columns of them.
  template <class Values>
  void half_kick(double half_step, const Values& v_sum, const Values& f_int, const Values& f_ext,
                 const Values& F) {
    const double factor = 0.5 * half_step;
    internal_.add(factor * f_int.cwiseProduct(v_sum).sum());
    loads_.add(factor * f_ext.cwiseProduct(v_sum).sum());
    forces_.add(factor * F.cwiseProduct(v_sum).sum());
  }
  Work work() const { return {internal_.value(), loads_.value(), forces_.value()}; }

 private:
  CompensatedSum internal_, loads_, forces_;
};

}  // namespace structure
