// SPDX-License-Identifier: GPL-2.0-or-later
// What isotropic elastic laws with two constants have in common.
#pragma once

#include "structure/material/material.h"

namespace structure {

class IsotropicElastic : public Material {
 public:
  double density() const final { return density_; }
  double youngs_modulus() const final { return E_; }
  double poissons_ratio() const final { return nu_; }
  double lambda() const { return lambda_; }  ///< Lame constants [Pa]
  double mu() const { return mu_; }

 protected:
  template <class Law>
  Law point_law() const {
    return {lambda_, mu_};
  }
  /// E [Pa], nu [-], density [kg/m^3].  Throws std::invalid_argument, naming the law, unless E > 0,
  /// -1 < nu < 0.5 and density > 0.
  IsotropicElastic(const char* law, double youngs_modulus, double poissons_ratio, double density);

  /// lambda tr(strain) I + 2 mu strain, for a symmetric strain.
  Matrix3 hooke(const Matrix3& strain) const {
    Matrix3 stress = 2.0 * mu_ * strain;
    stress.diagonal().array() += lambda_ * strain.trace();
    return stress;
  }

 private:
  double E_, nu_, density_;
  double lambda_, mu_;
};

}  // namespace structure
