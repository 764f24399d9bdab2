// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/material/material.h"

namespace structure {

Matrix3 Material::stress_change(const Matrix3& H, const Matrix3& G, const double* state) const {
  constexpr double kSmall = 1e-5;  // of H: truncation and rounding are both about its square
  const double size = G.lpNorm<Eigen::Infinity>();
  if (size == 0.0) return Matrix3::Zero();
  const Matrix3 step = (kSmall / size) * G;
  return (stress(H + step, state) - stress(H - step, state)) * (size / (2.0 * kSmall));
}

}  // namespace structure
