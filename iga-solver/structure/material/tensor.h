// SPDX-License-Identifier: GPL-2.0-or-later
// 3 x 3 tensors of any kind of number: doubles, or words of them.  Laws are written once on these.  Inlined
// always: kernels for newer processors must leave no function that others might be linked with.
#pragma once

namespace structure {

template <class Number>
struct Tensor {
  Number m[3][3];
  [[gnu::always_inline]] Number& operator()(int i, int j) { return m[i][j]; }
  [[gnu::always_inline]] const Number& operator()(int i, int j) const { return m[i][j]; }
};

/// H + H^T
template <class Number>
[[gnu::always_inline]] inline Tensor<Number> plus_transposed(const Tensor<Number>& H) {
  Tensor<Number> A;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) A(i, j) = A(j, i) = H(i, j) + H(j, i);
  return A;
}

/// A : B = sum A_ij B_ij
template <class Number>
[[gnu::always_inline]] inline Number double_dot(const Tensor<Number>& A, const Tensor<Number>& B) {
  Number sum = A(0, 0) * B(0, 0);
  for (int k = 1; k < 9; ++k) sum += A(k / 3, k % 3) * B(k / 3, k % 3);
  return sum;
}

/// lambda tr(strain) I + 2 mu strain, of twice a symmetric strain.
template <class Number>
[[gnu::always_inline]] inline Tensor<Number> hooke(double lambda, double mu,
                                                   const Tensor<Number>& twice_strain) {
  const Number pressure = 0.5 * lambda * (twice_strain(0, 0) + twice_strain(1, 1) + twice_strain(2, 2));
  Tensor<Number> stress;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) stress(i, j) = stress(j, i) = mu * twice_strain(i, j);
  for (int i = 0; i < 3; ++i) stress(i, i) += pressure;
  return stress;
}

}  // namespace structure
