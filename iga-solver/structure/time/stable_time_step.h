// SPDX-License-Identifier: GPL-2.0-or-later
// Largest time step of the central difference scheme: dt = 2 / omega_max, omega_max^2 the largest eigenvalue
// of M^-1 K (Hughes, The Finite Element Method, 2000, section 9.1).
#pragma once

#include "structure/body.h"
#include "structure/conditions/supports.h"
#include "structure/halo.h"
#include "structure/time/mass.h"

namespace structure {

/// What a *limit* on dt multiplies the stable step with: the iteration reaches omega_max from below, within
/// about 0.05 %, and neither that nor rounding may decide.
constexpr double kStableStepSafety = 0.98;

/// 2 / omega_max [time] about the displacements u, K being the derivative of the internal force, fixed dofs
/// left out; infinity if every dof is fixed.  By power iteration from a fixed pseudo-random vector,
/// accelerated after Lanczos: plain power iteration stalls for hundreds of steps below close or hidden top
/// frequencies, this one takes 30 to 60 evaluations of the internal force.  Throws std::runtime_error if the
/// iteration does not converge or meets numbers that are not finite, and std::logic_error if the result
/// contradicts the element bounds.
double stable_time_step(const Body& body, const MassOperator& mass, const Supports& supports,
                        const NodalVectors& u, const Halo& halo = Halo());

/// Bounds of omega_max^2 [1/time^2] from single elements, for row-sum lumped mass.
struct EigenvalueBounds {
  double low;   ///< Rayleigh quotient of an element's highest mode, held by the whole nodal masses
  double high;  ///< largest eigenvalue of any element with its own mass (Irons & Treharne 1971)
};
/// The elements' eigenvalues themselves come from a few power iterations, so `high` may be short by some per
/// cent.
EigenvalueBounds element_eigenvalue_bounds(const Body& body, const Supports& supports, const NodalVectors& u,
                                           const Halo& halo = Halo());

}  // namespace structure
