// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers that carry a derivative along: a law that is run on them gives the change of its stress with the
// strain, exactly.  Inlined always, as tensor.h.
// Source: Clifford (1873); forward differentiation: Griewank & Walther (2008), Evaluating Derivatives, ch. 3.
#pragma once

#include "structure/material/logarithm.h"
#include "structure/material/tensor.h"

namespace structure {

/// value + derivative e, e^2 = 0.
template <class Number>
struct Dual {
  Number value, derivative;

  [[gnu::always_inline]] Dual& operator+=(const Dual& b) {
    value += b.value;
    derivative += b.derivative;
    return *this;
  }
  [[gnu::always_inline]] Dual& operator+=(double b) {
    value += b;
    return *this;
  }
};

#define STRUCTURE_DUAL    \
  template <class Number> \
  [[gnu::always_inline]] inline
STRUCTURE_DUAL Dual<Number> operator+(const Dual<Number>& a, const Dual<Number>& b) {
  return {a.value + b.value, a.derivative + b.derivative};
}
STRUCTURE_DUAL Dual<Number> operator-(const Dual<Number>& a, const Dual<Number>& b) {
  return {a.value - b.value, a.derivative - b.derivative};
}
STRUCTURE_DUAL Dual<Number> operator*(const Dual<Number>& a, const Dual<Number>& b) {
  return {a.value * b.value, a.derivative * b.value + a.value * b.derivative};
}
STRUCTURE_DUAL Dual<Number> operator+(double a, const Dual<Number>& b) { return {a + b.value, b.derivative}; }
STRUCTURE_DUAL Dual<Number> operator+(const Dual<Number>& a, double b) { return {a.value + b, a.derivative}; }
STRUCTURE_DUAL Dual<Number> operator-(const Dual<Number>& a, double b) { return {a.value - b, a.derivative}; }
STRUCTURE_DUAL Dual<Number> operator*(double a, const Dual<Number>& b) {
  return {a * b.value, a * b.derivative};
}
STRUCTURE_DUAL Dual<Number> operator*(const Dual<Number>& a, double b) { return b * a; }
/// Of values alone, as a comparison of them.
STRUCTURE_DUAL auto operator<=(const Dual<Number>& a, double b) { return a.value <= b; }
#undef STRUCTURE_DUAL

/// d ln J = dJ / J, d(J - 1 - ln J) = (J - 1) dJ / J.
template <class Number>
[[gnu::always_inline]] inline Logarithm<Dual<Number>> logarithm(const Dual<Number>& J,
                                                                const Dual<Number>& x) {
  const Logarithm<Number> ln = logarithm(J.value, x.value);
  const Number d_ln = J.derivative * ln.inverse;
  return {{ln.value, d_ln}, {ln.excess, x.value * d_ln}, {ln.inverse, -d_ln * ln.inverse}};
}

/// dP/dH : G over the modulus, the change of a law's stress at H along G.
template <class Law, class Number>
[[gnu::always_inline]] inline Tensor<Number> unit_stress_change(const Law& law, const Tensor<Number>& H,
                                                                const Tensor<Number>& G) {
  Tensor<Dual<Number>> H_and_G;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) H_and_G(i, j) = {H(i, j), G(i, j)};
  const Tensor<Dual<Number>> P = law.unit_stress(H_and_G);
  Tensor<Number> dP;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) dP(i, j) = P(i, j).derivative;
  return dP;
}

}  // namespace structure
