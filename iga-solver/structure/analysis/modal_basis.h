// SPDX-License-Identifier: GPL-2.0-or-later
// What a linear body moves in, if it keeps its lowest modes alone: u = sum q_k phi_k + sum s_j psi_j.  The
// phi are modes of the body as its supports hold it; psi_j is where the motion of support j takes the body if
// it takes its time, so that the modes have no more to do than what inertia adds.
// Source: Craig & Kurdila (2006), secs. 11.3 and 17.2 (pseudo-static displacements).
#pragma once

#include <vector>

#include "structure/time/explicit_solver.h"

namespace structure {

struct ModalBasis {
  Eigen::VectorXd eigenvalues;       ///< omega_k^2 [1/time^2], rising; of motions of the whole body 0
  std::vector<NodalVectors> modes;   ///< phi_k, 3 x node_count, sum of m_A |phi_A|^2 = 1
  std::vector<NodalVectors> follow;  ///< psi_j, of Supports::motions()
};

/// About the undeformed body; `solver` is of a whole body of a linear law.  Throws as lowest_modes, and
/// std::runtime_error if supports move that do not hold the body.
ModalBasis modal_basis(const ExplicitSolver& solver, int count);

}  // namespace structure
