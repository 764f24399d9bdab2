// SPDX-License-Identifier: GPL-2.0-or-later
// Compressible neo-Hooke, for large strains of either sign: with F = I + H and J = det F
//   W = mu/2 (F : F - 3) - mu ln J + lambda/2 (ln J)^2,   P = mu (F - F^-T) + lambda ln J F^-T.
// P is not a number where J is not > 0.  In terms of H, no digits are lost where it is small: with C = cof F
// - I
//   P = mu (H - C + g (I + C)),   g = (J - 1 + lambda/mu ln J) / J.
// Source: Bonet & Wood (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, eqs. 6.27-6.28.
#pragma once

#include "structure/material/lame_constants.h"
#include "structure/material/logarithm.h"
#include "structure/material/tensor.h"

namespace structure {

struct NeoHookeLaw : LameConstants {
  static constexpr const char* kWord = "neo_hooke";
  static constexpr bool kSmallStrain = false;

  /// Lame constants [Pa].
  NeoHookeLaw(double lambda, double mu) : LameConstants(lambda, mu) {
    double harmonic = 0.0, sign = 1.0;
    for (int n = 0; n < kTerms; ++n, sign = -sign) {
      harmonic += 1.0 / (n + 1);
      series_[n] = sign * (1.0 + lambda_per_mu * harmonic);
    }
  }

  template <class Number>
  [[gnu::always_inline]] Tensor<Number> unit_stress(const Tensor<Number>& H) const {
    const VolumeChange<Number> change = volume_change(H);
    const Number g = spherical_stress(change.J, change.J_minus_1);
    Tensor<Number> P;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P(i, j) = H(i, j) + (g - 1.0) * change.C(i, j);
    for (int i = 0; i < 3; ++i) P(i, i) += g;
    return P;
  }
  // In terms of A = F^T F - I = 2 E, in which rotations leave no round-off of first order:
  //   W = mu/2 (tr A - ln J^2) + lambda/8 (ln J^2)^2,  tr A - ln J^2 = (J^2 - 1 - ln J^2) - (J^2 - 1 - tr A).
  template <class Number>
  [[gnu::always_inline]] Number unit_energy(const Tensor<Number>& H) const {
    const VolumeChange<Number> squared = volume_change(twice_green_lagrange(H));
    const Logarithm<Number> ln = logarithm(squared.J, squared.J_minus_1);
    return 0.5 * (ln.excess - squared.beyond_trace) + 0.125 * lambda_per_mu * (ln.value * ln.value);
  }

 private:
  static constexpr int kTerms = 8;
  static constexpr double kNear = 1.0 / 96.0;  // the term after the last is 4e-16 of the first there

  // Terms side by side: a chain of all of them would be waited for.
  template <class Number>
  [[gnu::always_inline]] static Number cubic(const double* c, const Number& x, const Number& xx) {
    return (c[0] + x * c[1]) + xx * (c[2] + x * c[3]);
  }
  // g of x = J - 1.  Where volumes have hardly changed, and that is where time counts, by its power series
  //   sum over n of (-1)^n (1 + lambda/mu (1 + 1/2 + ... + 1/(n + 1))) x^(n + 1).
  template <class Number>
  [[gnu::always_inline]] Number spherical_stress(const Number& J, const Number& x) const {
    const Number xx = x * x;
    if (__builtin_expect(all_true(xx <= kNear * kNear), true)) {
      const double* const c = series_;
      return x * (cubic(c, x, xx) + xx * xx * cubic(c + 4, x, xx));
    }
    const Logarithm<Number> ln_J = logarithm(J, x);
    return (x + lambda_per_mu * ln_J.value) * ln_J.inverse;
  }

  double series_[kTerms];
};

}  // namespace structure
