// SPDX-License-Identifier: GPL-2.0-or-later
// The innermost loops of products with the mass matrix (mass_sweep.h): rows and planes of whole words.
#pragma once

#include <cstddef>

#include "nurbs/simd_level.h"

namespace structure {

/// `count` numbers at a time, whole words of the longest; `terms` of them are added up, `step` numbers apart.
struct MassKernel {
  /// out = sum over a of factors[a] in[a].
  void (*gather)(const double* factors, int terms, const double* in, std::size_t step, std::size_t count,
                 double* out);
  /// out[a] += factors[a] in.
  void (*scatter)(const double* factors, int terms, const double* in, std::size_t count, double* out,
                  std::size_t step);
  /// out = M in, M a symmetric band matrix: M(i, i + k) at bands[k * step + i].  There are `width` zeros
  /// before and behind `in`, and before each band.
  void (*multiply)(const double* bands, std::size_t step, int width, const double* in, std::size_t count,
                   double* out);
};

const MassKernel& mass_kernel(nurbs::SimdLevel level);

}  // namespace structure
