// SPDX-License-Identifier: GPL-2.0-or-later
// Hooke's law between Green-Lagrange strain E and second Piola-Kirchhoff stress S, for large displacements
// and rotations at moderate strain:  S = lambda tr(E) I + 2 mu E,  E = (F^T F - I) / 2,  F = I + H,  P = F S.
// Under compression it softens and fails: dP/dF of a uniaxial state vanishes at a stretch of 1/sqrt(3).
// Source: Bonet & Wood (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, eqs. 6.28-6.29.
#pragma once

#include "structure/material/isotropic_elastic.h"

namespace structure {

class SaintVenantKirchhoff final : public IsotropicElastic {
 public:
  /// Arguments and errors as IsotropicElastic.
  SaintVenantKirchhoff(double youngs_modulus, double poissons_ratio, double density)
      : IsotropicElastic("SaintVenantKirchhoff", youngs_modulus, poissons_ratio, density) {}

  const char* law() const override { return "saint_venant_kirchhoff"; }
  Matrix3 stress(const Matrix3& H, const double* /*state*/) const override {
    const Matrix3 S = hooke(green_lagrange(H));
    return S + H * S;
  }
  double energy_density(const Matrix3& H, const double* /*state*/) const override {
    const Matrix3 E = green_lagrange(H);
    return 0.5 * hooke(E).cwiseProduct(E).sum();
  }

 private:
  // From H, not from F: no digits are lost where strains are small.
  static Matrix3 green_lagrange(const Matrix3& H) { return 0.5 * (H + H.transpose() + H.transpose() * H); }
};

}  // namespace structure
