// SPDX-License-Identifier: GPL-2.0-or-later
// An elastic law with viscosity in proportion to its stiffness: the second Piola-Kirchhoff stress is
//   S = S_elastic(E) + b C : dE/dt,  C = dS_elastic/dE,
// so that turning costs nothing.  Rates are those of the last step, taken about its middle, where
//   E(n+1) - E(n) = sym(F^T (H(n+1) - H(n)))
// holds whatever the rotation.  Of a law that is linear in H, P = P_elastic + b dP_elastic/dt.
// Source: Bonet & Wood (2008), sec. 4.6 (rates of E); Kelvin & Voigt's model.
#pragma once

#include <memory>
#include <string>

#include "structure/material/material.h"

namespace structure {

class Viscous final : public Material {
 public:
  /// `viscosity` b [time].  Throws std::invalid_argument unless the law has no memory of its own and b > 0.
  Viscous(std::shared_ptr<const Material> elastic, double viscosity);

  /// The viscous part is held as it was in the last step; it stores no energy.
  Matrix3 stress(const Matrix3& H, const double* state) const override;
  double energy_density(const Matrix3& H, const double* state) const override {
    return elastic_->energy_density(H, state);
  }
  Matrix3 cauchy_stress(const Matrix3& H, const double* state) const override;

  /// H, the viscous part of S (of a linear law: of P), and the work against it.
  int state_size() const override { return 19; }
  double dissipated_density(const double* state) const override { return state[18]; }
  void evolve(const Matrix3& H, double dt, const double* old, double* next) const override;
  double viscosity() const { return viscosity_; }
  const std::shared_ptr<const Material>& elastic() const { return elastic_; }
  bool is_small_strain() const override { return elastic_->is_small_strain(); }

  const char* law() const override { return law_.c_str(); }
  double density() const override { return elastic_->density(); }
  double youngs_modulus() const override { return elastic_->youngs_modulus(); }
  double poissons_ratio() const override { return elastic_->poissons_ratio(); }
  std::vector<double> further_constants() const override;

 private:
  std::shared_ptr<const Material> elastic_;
  double viscosity_;
  std::string law_;
};

/// b [time] of a law, 0 of one without.
inline double viscosity(const Material& material) {
  const auto* const viscous = dynamic_cast<const Viscous*>(&material);
  return viscous ? viscous->viscosity() : 0.0;
}

}  // namespace structure
