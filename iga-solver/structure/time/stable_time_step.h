// SPDX-License-Identifier: GPL-2.0-or-later
// Largest time step of the central difference scheme: dt = 2 / omega_max, omega_max^2 the largest eigenvalue
// of M^-1 K (Hughes, The Finite Element Method, 2000, section 9.1).
#pragma once

#include <string>

#include "structure/body.h"
#include "structure/conditions/springs.h"
#include "structure/conditions/supports.h"
#include "structure/halo.h"
#include "structure/time/mass.h"

namespace structure {

/// 2 / omega_max [time] about the displacements u, K being the derivative of the internal force and of
/// springs, fixed dofs
/// left out; infinity if every dof is fixed.  Not above the true one, and up to some 3 % below it: 20
/// evaluations of the internal force give a bound of omega_max from above (lanczos.h), from a pseudo-random
/// start that is the same in every run, however the body is cut.  For no body do more than one in 1,000
/// starts give a lower one.  Throws std::runtime_error if it meets numbers that are not finite, and
/// std::logic_error if K is not symmetric or the masses are not the body's.
double stable_time_step(const Body& body, const MassOperator& mass, const Supports& supports,
                        const NodalVectors& u, const Halo& halo = Halo(), const Springs& springs = {});

// Internal forces of the displacements u + lead v, v being that of half a step before, damp a mode of
// frequency omega by the ratio xi = omega lead/2 and take from its stable step: omega dt <= 2 (sqrt(1 + xi^2)
// - xi), the root of (omega dt)^2 + 2 omega^2 lead dt = 4 (its amplification matrix then has the eigenvalue
// -1).
/// The stable step [time] of a body that is damped so, from that without.
double damped_stable_step(double stable, double lead);
/// The step [time] that asks as much of the body without damping as dt with it: dt is stable while this is.
double undamped_step(double dt, double lead);

/// For messages: six digits, rounded down, so that the step that is told is stable, too.
std::string step_text(double stable);

}  // namespace structure
