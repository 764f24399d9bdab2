// SPDX-License-Identifier: GPL-2.0-or-later
// Several polynomials at one place, as functions on plain numbers: compiled once for each instruction set
// that simd_level.h knows.  All find the same digits, as nothing is fused.
#pragma once

#include "nurbs/simd_level.h"

namespace structure {

/// Four polynomials of s and t: values and derivatives.
struct FourPolynomials {
  static constexpr int kCount = 4;
  double value[kCount], by_s[kCount], by_t[kCount];
};

/// `coefficients`: [of t][of s][polynomial], `in_s`, `in_t` of them.
using TableKernel = void (*)(const double* coefficients, int in_s, int in_t, double s, double t,
                             FourPolynomials& out);
/// Throws std::invalid_argument if this machine does not have the instruction set.
TableKernel table_kernel(nurbs::SimdLevel level);

}  // namespace structure
