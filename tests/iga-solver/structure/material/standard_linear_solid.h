// SPDX-License-Identifier: GPL-2.0-or-later
// A law with memory, for tests: the standard linear solid, a spring beside a Maxwell element, at small
// strain.
//   W = g/2 eps : C : eps + (1 - g)/2 (eps - z) : C : (eps - z),   tau z' = eps - z,
// z being the strain of the dashpot, C the elasticity at once and g C that after a long time.
// Source: Simo & Hughes (1998), Computational Inelasticity, section 10.1; z by the trapezoidal rule, second
// order.
#pragma once

#include "structure/material/isotropic_elastic.h"

namespace test {

using structure::Matrix3;

class StandardLinearSolid final : public structure::IsotropicElastic {
 public:
  /// E and nu are those at once; 0 < g < 1 [-], tau [time].
  StandardLinearSolid(double youngs_modulus, double poissons_ratio, double density, double g, double tau)
      : IsotropicElastic("StandardLinearSolid", youngs_modulus, poissons_ratio, density), g_(g), tau_(tau) {}

  const char* law() const override { return "standard_linear_solid"; }
  std::vector<double> further_constants() const override { return {g_, tau_}; }
  Matrix3 stress(const Matrix3& H, const double* state) const override {
    return hooke(strain(H) - (1.0 - g_) * Stored(state));
  }
  double energy_density(const Matrix3& H, const double* state) const override {
    const Matrix3 eps = strain(H), spring = eps - Stored(state);
    return 0.5 * g_ * hooke(eps).cwiseProduct(eps).sum() +
           0.5 * (1.0 - g_) * hooke(spring).cwiseProduct(spring).sum();
  }

  /// z, and the strain of then.
  int state_size() const override { return 18; }
  void evolve(const Matrix3& H, double dt, const double* old, double* next) const override {
    const double h = 0.5 * dt / tau_;
    const Matrix3 eps = strain(H);
    const Stored z(old), eps_old(old + 9);
    Matrix3::Map(next) = ((1.0 - h) * z + h * (eps + eps_old)) / (1.0 + h);
    Matrix3::Map(next + 9) = eps;
  }

 private:
  using Stored = Eigen::Map<const Matrix3>;
  static Matrix3 strain(const Matrix3& H) { return 0.5 * (H + H.transpose()); }

  double g_, tau_;
};

}  // namespace test
