// SPDX-License-Identifier: GPL-2.0-or-later
// An isotropic law in a flat plate that is one quadratic element thick.  Such an element's shear strain
// across the plate is even through the thickness T where an elastic plate's is a parabola, so it gives way
// too little: under cos(k x) on one side that moves by 12 (1 - nu^2)/(E k (k T)^3) (1 + a (k T)^2 + ...), a =
// 1/5 of the plate, 1/6 of the element.  Where that strain meets 5/(6 - nu) of its stiffness a is 1/5, and
// flexural waves are right to the same order.  All else is as without. Source of the factor: Hutchinson
// (1984), J. Appl. Mech. 51, 581; Stephen (1997), J. Sound Vib. 202, 539; they have it of Mindlin's plate.
#pragma once

#include "structure/material/tensor.h"

namespace structure {

class PlateElastic;

constexpr double plate_shear_factor(double nu) { return 5.0 / (6.0 - nu); }

/// Base: a law of LameConstants, with kPlateWord, twice_strain and piola.
template <class Base>
struct PlateShearLaw : Base {
  using Constants = PlateElastic;
  static constexpr const char* kWord = Base::kPlateWord;

  /// Lame constants [Pa], the factor, the plate's unit normal.
  PlateShearLaw(double lambda, double mu, double factor, const double (&normal)[3])
      : Base(lambda, mu), less(1.0 - factor), n{normal[0], normal[1], normal[2]} {}

  template <class Number>
  [[gnu::always_inline]] Tensor<Number> unit_stress(const Tensor<Number>& H) const {
    return Base::piola(H, symmetric_stress(Base::twice_strain(H)));
  }
  template <class Number>
  [[gnu::always_inline]] Number unit_energy(const Tensor<Number>& H) const {
    const Tensor<Number> twice_E = Base::twice_strain(H);
    return 0.25 * double_dot(symmetric_stress(twice_E), twice_E);
  }

  double less, n[3];

 private:
  template <class Number>
  [[gnu::always_inline]] Tensor<Number> symmetric_stress(const Tensor<Number>& twice_E) const {
    Number gamma[3];  // by what the normal turns
    for (int i = 0; i < 3; ++i) gamma[i] = n[0] * twice_E(i, 0) + n[1] * twice_E(i, 1) + n[2] * twice_E(i, 2);
    const Number twice_stretch = n[0] * gamma[0] + n[1] * gamma[1] + n[2] * gamma[2];
    for (int i = 0; i < 3; ++i) gamma[i] = less * (gamma[i] - n[i] * twice_stretch);
    Tensor<Number> S = hooke(this->lambda_per_mu, twice_E);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) S(i, j) = S(i, j) - (n[i] * gamma[j] + n[j] * gamma[i]);
    return S;
  }
};

}  // namespace structure
