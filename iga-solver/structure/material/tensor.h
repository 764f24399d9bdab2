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

/// H + H^T + H^T H: twice Green-Lagrange's strain.  From H, not from F: no digits are lost where strains are
/// small.
template <class Number>
[[gnu::always_inline]] inline Tensor<Number> twice_green_lagrange(const Tensor<Number>& H) {
  Tensor<Number> A = plus_transposed(H);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) A(i, j) += H(k, i) * H(k, j);
      A(j, i) = A(i, j);
    }
  return A;
}

/// P = F S of a symmetric S.
template <class Number>
[[gnu::always_inline]] inline Tensor<Number> first_piola(const Tensor<Number>& H, const Tensor<Number>& S) {
  Tensor<Number> P = S;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) P(i, j) += H(i, k) * S(k, j);
  return P;
}

/// A : B = sum A_ij B_ij
template <class Number>
[[gnu::always_inline]] inline Number double_dot(const Tensor<Number>& A, const Tensor<Number>& B) {
  Number sum = A(0, 0) * B(0, 0);
  for (int k = 1; k < 9; ++k) sum += A(k / 3, k % 3) * B(k / 3, k % 3);
  return sum;
}

/// What F = I + H does to volumes; small where H is, to all digits.
template <class Number>
struct VolumeChange {
  Tensor<Number> C;  ///< cof F - I
  Number J, J_minus_1;
  Number beyond_trace;  ///< J - 1 - tr H
};
template <class Number>
[[gnu::always_inline]] inline VolumeChange<Number> volume_change(const Tensor<Number>& H) {
  VolumeChange<Number> change;
  Tensor<Number> F = H;
  for (int i = 0; i < 3; ++i) F(i, i) += 1.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      change.C(i, j) = i == j ? H(i1, i1) + F(i1, i1) * H(i2, i2) - H(i1, i2) * H(i2, i1)
                              : F(i1, j1) * F(i2, j2) - F(i1, j2) * F(i2, j1);
    }
  const Number sides = H(0, 1) * change.C(0, 1) + H(0, 2) * change.C(0, 2);
  change.J = F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) + sides;
  change.J_minus_1 = H(0, 0) + (F(0, 0) * change.C(0, 0) + sides);
  const Number minor = H(1, 1) * H(2, 2) - H(1, 2) * H(2, 1);
  change.beyond_trace = H(0, 0) * change.C(0, 0) + minor + sides;
  return change;
}

/// lambda/mu tr(strain) I + 2 strain, of twice a symmetric strain.
template <class Number>
[[gnu::always_inline]] inline Tensor<Number> hooke(double lambda_per_mu, const Tensor<Number>& twice_strain) {
  const Number pressure =
      0.5 * lambda_per_mu * (twice_strain(0, 0) + twice_strain(1, 1) + twice_strain(2, 2));
  Tensor<Number> stress = twice_strain;
  for (int i = 0; i < 3; ++i) stress(i, i) += pressure;
  return stress;
}

}  // namespace structure
