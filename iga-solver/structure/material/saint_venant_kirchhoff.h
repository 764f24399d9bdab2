// SPDX-License-Identifier: GPL-2.0-or-later
// Hooke's law between Green-Lagrange strain E and second Piola-Kirchhoff stress S, for large displacements
// and rotations at moderate strain:  S = lambda tr(E) I + 2 mu E,  E = (F^T F - I) / 2,  F = I + H,  P = F S.
// Under compression it softens and fails: dP/dF of a uniaxial state vanishes at a stretch of 1/sqrt(3).
// Source: Bonet & Wood (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, eqs. 6.28-6.29.
#pragma once

#include "structure/material/tensor.h"

namespace structure {

struct SaintVenantKirchhoffLaw {
  static constexpr const char* kWord = "saint_venant_kirchhoff";
  double lambda, mu;  // Lame constants [Pa]

  template <class Number>
  [[gnu::always_inline]] Tensor<Number> stress(const Tensor<Number>& H) const {
    const Tensor<Number> S = hooke(lambda, mu, twice_green_lagrange(H));
    Tensor<Number> P = S;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) P(i, j) += H(i, k) * S(k, j);
    return P;
  }
  template <class Number>
  [[gnu::always_inline]] Number energy_density(const Tensor<Number>& H) const {
    const Tensor<Number> twice_E = twice_green_lagrange(H);
    return 0.25 * double_dot(hooke(lambda, mu, twice_E), twice_E);
  }

 private:
  // From H, not from F: no digits are lost where strains are small.
  template <class Number>
  [[gnu::always_inline]] static Tensor<Number> twice_green_lagrange(const Tensor<Number>& H) {
    Tensor<Number> A = plus_transposed(H);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) A(i, j) += H(k, i) * H(k, j);
        A(j, i) = A(i, j);
      }
    return A;
  }
};

}  // namespace structure
