// SPDX-License-Identifier: GPL-2.0-or-later
// Hooke's law between Green-Lagrange strain E and second Piola-Kirchhoff stress S, for large displacements
// and rotations at moderate strain:  S = lambda tr(E) I + 2 mu E,  E = (F^T F - I) / 2,  F = I + H,  P = F S.
// Under compression it softens and fails: dP/dF of a uniaxial state vanishes at a stretch of 1/sqrt(3).
// Source: Bonet & Wood (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, eqs. 6.28-6.29.
#pragma once

#include "structure/material/lame_constants.h"
#include "structure/material/tensor.h"

namespace structure {

struct SaintVenantKirchhoffLaw : LameConstants {
  using LameConstants::LameConstants;
  using Constants = IsotropicElastic;
  static constexpr const char *kWord = "saint_venant_kirchhoff",
                              *kPlateWord = "saint_venant_kirchhoff, shear corrected";
  static constexpr bool kSmallStrain = false;

  template <class Number>
  [[gnu::always_inline]] static Tensor<Number> twice_strain(const Tensor<Number>& H) {
    return twice_green_lagrange(H);
  }
  /// P of a symmetric stress S.
  template <class Number>
  [[gnu::always_inline]] static Tensor<Number> piola(const Tensor<Number>& H, const Tensor<Number>& S) {
    return first_piola(H, S);
  }
  template <class Number>
  [[gnu::always_inline]] Tensor<Number> unit_stress(const Tensor<Number>& H) const {
    return piola(H, hooke(lambda_per_mu, twice_strain(H)));
  }
  template <class Number>
  [[gnu::always_inline]] Number unit_energy(const Tensor<Number>& H) const {
    const Tensor<Number> twice_E = twice_strain(H);
    return 0.25 * double_dot(hooke(lambda_per_mu, twice_E), twice_E);
  }
};

}  // namespace structure
