// SPDX-License-Identifier: GPL-2.0-or-later
// Isotropic linear elasticity for small strain: sigma = lambda tr(eps) I + 2 mu eps, eps = (H + H^T) / 2.
// Source: Gao & Feng (2019), eq. 17 (there in Voigt notation).
#pragma once

#include "structure/material/lame_constants.h"
#include "structure/material/tensor.h"

namespace structure {

struct LinearElasticLaw : LameConstants {
  using LameConstants::LameConstants;
  using Constants = IsotropicElastic;
  static constexpr const char *kWord = "linear_elastic", *kPlateWord = "linear_elastic, shear corrected";
  static constexpr bool kSmallStrain = true;

  template <class Number>
  [[gnu::always_inline]] static Tensor<Number> twice_strain(const Tensor<Number>& H) {
    return plus_transposed(H);
  }
  /// P of a symmetric stress.
  template <class Number>
  [[gnu::always_inline]] static Tensor<Number> piola(const Tensor<Number>& /*H*/, const Tensor<Number>& S) {
    return S;
  }
  template <class Number>
  [[gnu::always_inline]] Tensor<Number> unit_stress(const Tensor<Number>& H) const {
    return hooke(lambda_per_mu, twice_strain(H));
  }
  template <class Number>
  [[gnu::always_inline]] Number unit_energy(const Tensor<Number>& H) const {
    return 0.5 * double_dot(unit_stress(H), H);
  }
};

}  // namespace structure
