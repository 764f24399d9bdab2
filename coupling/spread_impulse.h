// SPDX-License-Identifier: GPL-2.0-or-later
// Impulses that hardly resonate.  A contact kicks a fast structure once in a particle step H, and resonates
// with vibrations that turn by k pi in it.  Here the nodes are kicked by phi(K M^-1) f in place of f: what
// the body's own waves make of f, averaged over the times within H of the kick with the weights of a hat, and
// that once more,
//   phi(omega) = (sin(omega H/2) / (omega H/2))^4 for small steps of the body.
// It is never negative (a square), so with displacements scaled by phi^(1/2), mode by mode, this is the
// mollified impulse method of Garcia-Archilla, Sanz-Serna & Skeel (1999, SIAM J. Sci. Comput. 20, 930-963)
// with a filter phi^(1/2).  phi is 1 for rigid motion, so momentum is kept.
#pragma once

#include "nurbs/types.h"
#include "structure/time/explicit_solver.h"

namespace coupling {

class SpreadImpulse {
 public:
  /// Of a body of a linear law; keeps a reference.
  explicit SpreadImpulse(const structure::ExplicitSolver& solver) : solver_(solver) {}

  /// Nodal forces [force], whole at the nodes that the part owns, to those that kick in their place; `count`
  /// steps h [time] of the body make one of the particles.  2 count - 2 internal forces, none where nobody
  /// touches.  Collective.
  void apply(nurbs::NodalVectors& forces, double h, int count);

 private:
  void average(nurbs::NodalVectors& forces, double half_square, int count);
  void multiply(const nurbs::NodalVectors& q, double half_square);

  const structure::ExplicitSolver& solver_;
  nurbs::NodalVectors before_, now_, z_, f_;
};

/// phi of a mode of frequency omega [1/time].
double spread_share(double omega, double h, int count);

}  // namespace coupling
