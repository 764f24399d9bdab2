// SPDX-License-Identifier: GPL-2.0-or-later
// Preconditioned conjugate gradients.  Source: Hestenes & Stiefel (1952), J. Res. Natl. Bur. Stand. 49,
// 409-436; Saad (2003), Iterative Methods for Sparse Linear Systems, algorithm 9.1.
#pragma once

#include "structure/analysis/preconditioner.h"

namespace structure {

/// Of all components.
inline double dot(const NodalVectors& a, const NodalVectors& b) { return a.cwiseProduct(b).sum(); }

struct CgLimits {
  double tolerance;            ///< of |b - A x| / |b|
  int most_products = 10'000;  ///< of A
};

struct CgResult {
  int products = 0;
  double residual = 0.0;  ///< |b - A x| / |b| of the recurrence
  bool converged = false;
  bool is_positive = true;  ///< false: stopped at a direction p with p . A p <= 0, before taking it
};

/// Solves A x = b, all 3 x n; x is set, and is the preconditioned b where the first direction is not
/// positive.
CgResult conjugate_gradients(const Product& A, const Preconditioner& P, const NodalVectors& b,
                             NodalVectors& x, const CgLimits& limits);

}  // namespace structure
