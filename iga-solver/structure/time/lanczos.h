// SPDX-License-Identifier: GPL-2.0-or-later
// Bounds of the largest eigenvalue of a symmetric operator A from a few of its products, by the three-term
// recurrence of Lanczos (1950)
//   b(j+1) q(j+1) = A q(j) - a(j) q(j) - b(j) q(j-1),   |q(j)| = 1.
// With the polynomials of that recurrence, p(0) = 1 and b(j+1) p(j+1)(x) = (x - a(j)) p(j)(x) - b(j)
// p(j-1)(x), the unit eigenvector y of an eigenvalue x has <q(j), y> = <q(0), y> p(j)(x); q(0), ..., q(k) are
// orthonormal, so (Bessel)
//   <q(0), y>^2 (p(0)(x)^2 + ... + p(k)(x)^2) <= 1:
// an eigenvalue beyond the bound would need a start that hides its eigenvector.
// Source: van Dorsselaer, Hochstenbach & van der Vorst (2000), SIAM J. Matrix Anal. Appl. 22, 837-852, who
// take p(k) alone.
#pragma once

#include <vector>

namespace structure {

/// k steps of the recurrence.
struct Tridiagonal {
  std::vector<double> a;  ///< a(0), ..., a(k-1)
  std::vector<double> b;  ///< b(1), ..., b(k)
};

/// The smallest x above all Ritz values for which the sum of squares above is 1 / hidden^2: no eigenvalue
/// whose eigenvector has more than `hidden` of the start, |<q(0), y>| > hidden, is larger.
double eigenvalue_bound(const Tridiagonal& T, double hidden);

/// Largest `hidden` that a random start has with a chance of at most `chance`, whatever the unit vector y: of
/// a start v / norm, norm = |v|, with independent entries of v uniform in [-1, 1], the density of <v, y> is
/// at most 1 / sqrt(2), since no plane cuts more than sqrt(2) out of a unit cube (Ball 1986, Proc. AMS 97,
/// 465-473).
double hidden_share(double norm, double chance);

}  // namespace structure
