// SPDX-License-Identifier: GPL-2.0-or-later
// The passes of velocity Verlet over nodal vectors, one for each half of a step: memory bounds them, so every
// vector is read and written once, and all sums that the step needs are taken on the way.
#pragma once

#include <Eigen/Core>

#include "nurbs/types.h"

namespace structure {

using nurbs::NodalVectors;

/// One number for each kind of nodal forces, in this order; those of supports where they move.
enum { kInternal, kLoads, kForces, kSupports, kDamping, kForceKinds };
using PerForce = Eigen::Array<double, kForceKinds, 1>;

/// Of each kind of forces f: f . v and f . a [energy/time, energy/time^2] at the end of a half kick.
struct ForceSums {
  PerForce f_v = PerForce::Zero(), f_a = PerForce::Zero();

  // Work of a half kick, h f . (v + v')/2 with v' = v + h a, h half a time step.
  PerForce work_until_now(double h) const { return h * (f_v - 0.5 * h * f_a); }  ///< v' is now
  PerForce work_from_now(double h) const { return h * (f_v + 0.5 * h * f_a); }   ///< v is now
};

/// Nodal forces [force], 3 x n.
struct NodalForces {
  const NodalVectors &internal, &loads, &forces;
  const NodalVectors* damping = nullptr;  ///< if it is known before the kick
};

/// v += dt/2 a, u += dt v, x = reference + u, all 3 x n.  Returns the largest |u_i| [length].
double kick_and_drift(double dt, const NodalVectors& a, const NodalVectors& reference, NodalVectors& v,
                      NodalVectors& u, NodalVectors& x);

/// a = (loads + forces - internal) / m, v += h a, in `count` columns from `first`; the sums are over these,
/// and the same to the last bit wherever they stand.  `inverse_mass` [1/mass] is 3 x n: 0 where a dof is
/// fixed, which no force moves.  `damping` [1/time]: with it also - damping m v, at the v that the kick leads
/// to, so that free motion loses (1 - damping h) / (1 + damping h) in a whole step.
ForceSums accelerate_and_kick(double h, const NodalForces& f, const NodalVectors& inverse_mass,
                              Eigen::Index first, Eigen::Index count, NodalVectors& a, NodalVectors& v,
                              double damping = 0.0);

/// The same with accelerations a that are known.
ForceSums kick(double h, const NodalForces& f, Eigen::Index first, Eigen::Index count, const NodalVectors& a,
               NodalVectors& v);

}  // namespace structure
