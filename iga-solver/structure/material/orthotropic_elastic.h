// SPDX-License-Identifier: GPL-2.0-or-later
// Orthotropic elasticity for large displacements and rotations at moderate strain, in St. Venant-Kirchhoff's
// form: second Piola-Kirchhoff stress S = C : E of Green-Lagrange's strain E, P = F S.  The material's axes
// are those of the undeformed body and turn with it.
// Source: Bonet & Wood (2008), sec. 6.4; stiffness: Jones (1999), Mechanics of Composite Materials, sec. 2.3.
#pragma once

#include "structure/material/tensor.h"

namespace structure {

class OrthotropicElastic;

struct OrthotropicElasticLaw {
  using Constants = OrthotropicElastic;
  static constexpr const char* kWord = "orthotropic_elastic";
  static constexpr bool kSmallStrain = false;
  static constexpr int kRow[6] = {0, 1, 2, 0, 1, 0}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  static constexpr double modulus = 1.0;  // [Pa]
  double C[6][6];  // [Pa] in the axes of space: S_xx, S_yy, S_zz, S_xy, S_yz, S_xz of E_xx ... 2 E_xy ...

  template <class Number>
  [[gnu::always_inline]] Tensor<Number> unit_stress(const Tensor<Number>& H) const {
    return first_piola(H, second_piola(twice_green_lagrange(H)));
  }
  template <class Number>
  [[gnu::always_inline]] Number unit_energy(const Tensor<Number>& H) const {
    const Tensor<Number> twice_E = twice_green_lagrange(H);
    return 0.25 * double_dot(second_piola(twice_E), twice_E);
  }

 private:
  template <class Number>
  [[gnu::always_inline]] Tensor<Number> second_piola(const Tensor<Number>& twice_E) const {
    Tensor<Number> S;
    for (int a = 0; a < 6; ++a) {
      Number sum = C[a][3] * twice_E(0, 1) + C[a][4] * twice_E(1, 2) + C[a][5] * twice_E(0, 2);
      for (int b = 0; b < 3; ++b) sum += (0.5 * C[a][b]) * twice_E(b, b);
      S(kRow[a], kColumn[a]) = S(kColumn[a], kRow[a]) = sum;
    }
    return S;
  }
};

}  // namespace structure
