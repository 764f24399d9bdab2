// SPDX-License-Identifier: GPL-2.0-or-later
// Loops that show what the machine can do at most, and the product by a block matrix, which wants the same
// words; compiled for each instruction set as the product's kernels are.
#pragma once

#include <cstddef>

namespace benchmarks {

/// Compressed rows of 3 x 3 blocks, as raw arrays: no inline function of a class may be compiled here.
struct BlockRows {
  int rows;
  const int* begin;      ///< [row + 1] into `column`
  const int* column;     ///< [block]
  const double* values;  ///< [block][column of it][row of it], and one number to load beyond the last
};

struct MachineKernels {
  /// Sum of `count` numbers, a multiple of 64: read once, in order.
  double (*read)(const double* numbers, std::size_t count);
  /// `rounds` of independent chains x = a x + b, as many as hide the latency.
  double (*multiply_add)(std::size_t rounds, double a, double b);
  double flops_per_round;  ///< two for each multiplication with addition
  /// y = K x, both [3 rows].
  void (*multiply)(const BlockRows& K, const double* x, double* y);
};

/// For the instruction set that nurbs::simd_level() chooses.
const MachineKernels& machine_kernels();

}  // namespace benchmarks
