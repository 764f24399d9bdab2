// SPDX-License-Identifier: GPL-2.0-or-later
// A law without memory behind the material seam.
#pragma once

#include "structure/material/dual.h"
#include "structure/material/isotropic_elastic.h"
#include "structure/material/orthotropic_constants.h"
#include "structure/material/plate_constants.h"
#include "structure/material/tensor.h"

namespace structure {

/// Law: a struct with kWord, kSmallStrain (P is the Cauchy stress), a modulus [Pa] and, in units of it,
/// unit_stress(H) and unit_energy(H) for any kind of number, made by its Constants (IsotropicElastic: of
/// lambda and mu).
template <class Law>
class ElasticMaterial final : public Law::Constants {
 public:
  /// Arguments and errors as those of the Constants.
  template <class... Arguments>
  explicit ElasticMaterial(const Arguments&... arguments)
      : Law::Constants(Law::kWord, arguments...), law_(this->template point_law<Law>()) {}

  const Law& inlined_law() const { return law_; }

  const char* law() const override { return Law::kWord; }
  Matrix3 stress(const Matrix3& H, const double* /*state*/) const override {
    return law_.modulus * matrix(law_.unit_stress(tensor(H)));
  }
  Matrix3 stress_change(const Matrix3& H, const Matrix3& G, const double* /*state*/) const override {
    return law_.modulus * matrix(unit_stress_change(law_, tensor(H), tensor(G)));
  }
  bool is_linear() const override { return Law::kSmallStrain; }
  Matrix3 cauchy_stress(const Matrix3& H, const double* state) const override {
    return Law::kSmallStrain ? stress(H, state) : Material::cauchy_stress(H, state);
  }
  double energy_density(const Matrix3& H, const double* /*state*/) const override {
    return law_.modulus * law_.unit_energy(tensor(H));
  }

 private:
  static Tensor<double> tensor(const Matrix3& H) {
    return {{{H(0, 0), H(0, 1), H(0, 2)}, {H(1, 0), H(1, 1), H(1, 2)}, {H(2, 0), H(2, 1), H(2, 2)}}};
  }
  static Matrix3 matrix(const Tensor<double>& P) {
    return (Matrix3() << P(0, 0), P(0, 1), P(0, 2), P(1, 0), P(1, 1), P(1, 2), P(2, 0), P(2, 1), P(2, 2))
        .finished();
  }

  Law law_;
};

}  // namespace structure
