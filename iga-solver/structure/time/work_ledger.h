// SPDX-License-Identifier: GPL-2.0-or-later
// The work of nodal forces by the rule of velocity Verlet: a half kick by a force F, which takes v to v',
// does dt/2 F . (v + v')/2.  Summed so, kinetic energy + internal + damped - loads - forces - supports is
// constant to round-off, whatever the forces and the step: what is left over is energy that a force brought
// in unseen.
#pragma once

#include <array>

#include "structure/halo.h"
#include "structure/time/verlet_update.h"

namespace structure {

/// [energy]
struct Work {
  /// Done against internal forces: the change of strain energy and what a material with a memory has
  /// dissipated, up to the error of the step.
  double internal = 0.0;
  double loads = 0.0;     ///< of the external loads
  double forces = 0.0;    ///< of somebody's forces (contact)
  double supports = 0.0;  ///< of supports that move
  double damped = 0.0;    ///< taken by damping; the ledger has that in proportion to the mass
};

class WorkLedger {
 public:
  /// Of a half kick, for the nodes of one run (ForceSums).
  void half_kick(const PerForce& work) {
    for (int k = 0; k < kForceKinds; ++k) sums_[k].add(work[k]);
  }
  /// Of all parts; collective.
  Work work(const Halo& halo) const {
    std::array<ExactSum, kForceKinds> all = sums_;
    halo.sum(all.data(), all.size());
    return {all[kInternal].value(), all[kLoads].value(), all[kForces].value(), all[kSupports].value(),
            0.0 - all[kDamping].value()};
  }
  /// From now on it has these beside what is added.
  void set_sums(const std::array<ExactSum, kForceKinds>& sums) { sums_ = sums; }
  /// Of this part.
  const std::array<ExactSum, kForceKinds>& sums() const { return sums_; }

 private:
  std::array<ExactSum, kForceKinds> sums_;
};

}  // namespace structure
