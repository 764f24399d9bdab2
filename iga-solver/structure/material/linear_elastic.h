// SPDX-License-Identifier: GPL-2.0-or-later
// Isotropic linear elasticity for small strain: sigma = lambda tr(eps) I + 2 mu eps, eps = (H + H^T) / 2.
// Source: Gao & Feng (2019), eq. 17 (there in Voigt notation).
#pragma once

#include "structure/material/isotropic_elastic.h"

namespace structure {

class LinearElastic final : public IsotropicElastic {
 public:
  /// Arguments and errors as IsotropicElastic.
  LinearElastic(double youngs_modulus, double poissons_ratio, double density)
      : IsotropicElastic("LinearElastic", youngs_modulus, poissons_ratio, density) {}

  const char* law() const override { return "linear_elastic"; }
  Matrix3 stress(const Matrix3& H, const double* /*state*/) const override {
    return hooke(0.5 * (H + H.transpose()));
  }
  double energy_density(const Matrix3& H, const double* state) const override {
    return 0.5 * stress(H, state).cwiseProduct(H).sum();
  }
};

}  // namespace structure
