// SPDX-License-Identifier: GPL-2.0-or-later
// Free vibrations: the lowest eigenvalues of K(u) phi = omega^2 M phi.  Shift and invert: Lanczos' method for
// (K + s M)^-1 M, of which conjugate gradients work out the inverse; s > 0 where the body can move as a
// whole. Source: Ericsson & Ruhe (1980), Math. Comput. 35, 1251-1268; restarts: Sorensen (1992), by Spectra.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "structure/analysis/choose_preconditioner.h"

namespace structure {

struct ModeOptions {
  int count = 10;           ///< how many, the lowest
  double tolerance = 1e-8;  ///< of eigenvalues, relative
  PreconditionerKind preconditioner = PreconditionerKind::automatic;
  MassKind mass = MassKind::lumped;
  /// Told after each system of equations: how many are solved, and how many it takes at least.
  std::function<void(int solved, int at_least)> on_solve = {};
};

struct Mode {
  double eigenvalue;         ///< omega^2 [1/time^2]; of motions of the whole body 0, within rounding
  NodalVectors shape;        ///< 3 x node_count, phi . M phi = 1; 0 at fixed degrees of freedom
  double frequency() const;  ///< omega / (2 pi) [1/time]
};

/// Rising, about displacements u.  Throws std::invalid_argument if there are not so
/// many modes, std::runtime_error if they are not found or the body is unstable at u.
std::vector<Mode> lowest_modes(const Body& body, const Supports& supports, const NodalVectors& u,
                               const ModeOptions& options = {},
                               const Springs& springs = Tangent::no_springs());

}  // namespace structure
