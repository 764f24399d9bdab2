// SPDX-License-Identifier: GPL-2.0-or-later
// What isotropic laws for kernels have in common: stresses in units of the shear modulus, which a kernel
// multiplies into the weight of a point once, not into each stress.
#pragma once

namespace structure {

class IsotropicElastic;

struct LameConstants {
  using Constants = IsotropicElastic;

  /// Lame constants [Pa].
  LameConstants(double lambda, double mu) : modulus(mu), lambda_per_mu(lambda / mu) {}

  double modulus;        ///< mu [Pa]
  double lambda_per_mu;  ///< [-]
};

}  // namespace structure
