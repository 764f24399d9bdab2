// SPDX-License-Identifier: GPL-2.0-or-later
// Compressible neo-Hooke, for large strains of either sign: with F = I + H and J = det F
//   W = mu/2 (F : F - 3) - mu ln J + lambda/2 (ln J)^2,   P = mu (F - F^-T) + lambda ln J F^-T.
// P is not a number where J is not > 0.  In terms of H, no digits are lost where it is small: with C = cof F
// - I
//   P = mu (H - C) + g (I + C),   g = (mu (J - 1) + lambda ln J) / J.
// Source: Bonet & Wood (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, eqs. 6.27-6.28.
#pragma once

#include "structure/material/logarithm.h"
#include "structure/material/tensor.h"

namespace structure {

class IsotropicElastic;

struct NeoHookeLaw {
  using Constants = IsotropicElastic;
  static constexpr const char* kWord = "neo_hooke";
  static constexpr bool kSmallStrain = false;

  /// Lame constants [Pa].
  NeoHookeLaw(double lambda, double mu) : lambda_(lambda), mu_(mu) {
    double harmonic = 0.0, sign = 1.0;
    for (int n = 0; n < kTerms; ++n, sign = -sign) {
      harmonic += 1.0 / (n + 1);
      series_[n] = sign * (mu + lambda * harmonic);
    }
  }

  template <class Number>
  [[gnu::always_inline]] Tensor<Number> stress(const Tensor<Number>& H) const {
    const VolumeChange<Number> change = volume_change(H);
    const Number g = spherical_stress(change.J, change.J_minus_1);
    Tensor<Number> P;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P(i, j) = mu_ * H(i, j) + (g - mu_) * change.C(i, j);
    for (int i = 0; i < 3; ++i) P(i, i) += g;
    return P;
  }
  // In terms of A = F^T F - I = 2 E, in which rotations leave no round-off of first order:
  //   W = mu/2 (tr A - ln J^2) + lambda/8 (ln J^2)^2,  tr A - ln J^2 = (J^2 - 1 - ln J^2) - (J^2 - 1 - tr A).
  template <class Number>
  [[gnu::always_inline]] Number energy_density(const Tensor<Number>& H) const {
    const VolumeChange<Number> squared = volume_change(twice_green_lagrange(H));
    const Logarithm<Number> ln = logarithm(squared.J, squared.J_minus_1);
    return 0.5 * mu_ * (ln.excess - squared.beyond_trace) + 0.125 * lambda_ * (ln.value * ln.value);
  }

 private:
  static constexpr int kTerms = 12;
  static constexpr double kNear = 3.0 / 64.0;  // the term after the last is 4e-16 of the first there

  // Terms side by side: a chain of all of them would be waited for.
  template <class Number>
  [[gnu::always_inline]] static Number cubic(const double* c, const Number& x, const Number& xx) {
    return (c[0] + x * c[1]) + xx * (c[2] + x * c[3]);
  }
  // g of x = J - 1.  Where volumes have hardly changed, and that is where time counts, by its power series
  //   sum over n of (-1)^n (mu + lambda (1 + 1/2 + ... + 1/(n + 1))) x^(n + 1).
  template <class Number>
  [[gnu::always_inline]] Number spherical_stress(const Number& J, const Number& x) const {
    const Number xx = x * x;
    if (__builtin_expect(all_true(xx <= kNear * kNear), true)) {
      const Number x4 = xx * xx;
      const double* const c = series_;
      return x * (cubic(c, x, xx) + x4 * (cubic(c + 4, x, xx) + x4 * cubic(c + 8, x, xx)));
    }
    const Logarithm<Number> ln_J = logarithm(J, x);
    return (mu_ * x + lambda_ * ln_J.value) * ln_J.inverse;
  }

  double lambda_, mu_;
  double series_[kTerms];
};

}  // namespace structure
