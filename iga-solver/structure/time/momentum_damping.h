// SPDX-License-Identifier: GPL-2.0-or-later
// Damping by the mass, forces - rate M v, where M is no diagonal matrix: of momenta p = M v, which only
// forces change, so that they are carried from step to step in place of the product.  With p' = p + h (f -
// rate p') free motion loses (1 - rate h) / (1 + rate h) in a whole step of two such kicks.
#pragma once

#include "structure/time/mass.h"

namespace structure {

/// Arrays are 3 x n; fixed dofs, and columns that the part does not own, are not damped.
class MomentumDamping {
 public:
  /// rate [1/time] > 0.
  MomentumDamping(double rate, const MassOperator& mass, Eigen::Index owned);

  /// Momenta are others from now on, those of the velocities that start() is told.
  void forget() { is_known_ = false; }
  /// Collective, unless they are known.
  void start(const MassOperator& mass, const NodalVectors& v);
  /// They have gained these [mass length/time].
  void add(const NodalVectors& momenta) { p_ += momenta; }

  /// Of nodal forces f [force] at the end of a half kick of length h, or now if h is 0: adds those of
  /// damping.
  void kick(double h, NodalVectors& f);
  /// By the forces of now.
  void kick_on(double h) { p_.noalias() += h * f_; }

  /// - rate p [force].
  const NodalVectors& forces() const { return damping_; }
  const NodalVectors& momenta() const { return p_; }
  void set_momenta(const NodalVectors& p);

 private:
  NodalVectors rate_;             // 0 where it is none
  NodalVectors p_, f_, damping_;  // momenta; what changes them; of that the part of damping
  bool is_known_ = false;
};

}  // namespace structure
