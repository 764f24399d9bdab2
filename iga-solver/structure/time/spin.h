// SPDX-License-Identifier: GPL-2.0-or-later
// How fast a body turns as a whole.
#pragma once

#include "nurbs/types.h"
#include "structure/halo.h"

namespace structure {

/// The angular velocity [1/time] of the rigid body that has these nodes' masses, places and momenta: I^-1 L
/// about the centre of mass.  x, v: 3 x n, of all nodes that a part holds, masses: n.  Collective.
nurbs::Vector3 spin(const nurbs::NodalVectors& x, const nurbs::NodalVectors& v, const Eigen::VectorXd& masses,
                    const Halo& halo);

}  // namespace structure
