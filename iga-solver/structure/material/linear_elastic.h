// SPDX-License-Identifier: GPL-2.0-or-later
// Isotropic linear elasticity for small strain: sigma = lambda tr(eps) I + 2 mu eps, eps = (H + H^T) / 2.
// Source: Gao & Feng (2019), eq. 17 (there in Voigt notation).
#pragma once

#include "structure/material/tensor.h"

namespace structure {

class IsotropicElastic;

struct LinearElasticLaw {
  using Constants = IsotropicElastic;
  static constexpr const char* kWord = "linear_elastic";
  static constexpr bool kSmallStrain = true;
  double lambda, mu;  // Lame constants [Pa]

  template <class Number>
  [[gnu::always_inline]] Tensor<Number> stress(const Tensor<Number>& H) const {
    return hooke(lambda, mu, plus_transposed(H));
  }
  template <class Number>
  [[gnu::always_inline]] Number energy_density(const Tensor<Number>& H) const {
    return 0.5 * double_dot(stress(H), H);
  }
};

}  // namespace structure
