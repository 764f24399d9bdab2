// SPDX-License-Identifier: GPL-2.0-or-later
// Isotropic linear elasticity for small strain: sigma = lambda tr(eps) I + 2 mu eps, eps = (H + H^T) / 2.
// Source: Gao & Feng (2019), eq. 17 (there in Voigt notation).
#pragma once

#include "structure/material.h"

namespace structure {

class LinearElastic final : public Material {
 public:
  /// E [Pa], nu [-], density [kg/m^3].  Throws std::invalid_argument unless E > 0, -1 < nu < 0.5 and density
  /// > 0.
  LinearElastic(double youngs_modulus, double poissons_ratio, double density);

  Matrix3 stress(const Matrix3& H) const override;
  double energy_density(const Matrix3& H) const override;

  double density() const override { return density_; }
  double youngs_modulus() const override { return E_; }
  double poissons_ratio() const override { return nu_; }

 private:
  double E_, nu_, density_;
  double lambda_, mu_;  // Lame constants [Pa]
};

}  // namespace structure
