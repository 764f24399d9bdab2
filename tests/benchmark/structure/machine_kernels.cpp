// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, NURBS_SIMD_LEVEL.
#include "machine_kernels.h"

#include <cstring>

#include "nurbs/lanes.h"

namespace benchmarks::NURBS_SIMD_LEVEL {

namespace {

using nurbs::lanes::kLanes;
using Word = nurbs::lanes::Lanes;
typedef double Column __attribute__((vector_size(32)));  // of a block, and one number that is not used

template <class W>
[[gnu::always_inline]] inline W load(const double* numbers) {
  W word;
  std::memcpy(&word, numbers, sizeof(W));
  return word;
}

double read(const double* numbers, std::size_t count) {
  constexpr int kSums = 8;
  Word sums[kSums] = {};
  for (std::size_t i = 0; i < count; i += kSums * kLanes)
#pragma GCC unroll 8
    for (int s = 0; s < kSums; ++s) sums[s] += load<Word>(numbers + i + s * kLanes);
  double total = 0.0;
  for (const Word& sum : sums)
    for (int lane = 0; lane < kLanes; ++lane) total += sum[lane];
  return total;
}

constexpr int kChains = 12;  // 2 per cycle of latency 4 to 5, in 16 registers

double multiply_add(std::size_t rounds, double a, double b) {
  Word chains[kChains];
  for (int c = 0; c < kChains; ++c) chains[c] = Word{} + c;
  const Word factor = Word{} + a, summand = Word{} + b;
  for (std::size_t i = 0; i < rounds; ++i)
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) chains[c] = factor * chains[c] + summand;
  Word sum{};
  for (const Word& chain : chains) sum += chain;
  return sum[0] + sum[kLanes - 1];
}

/// Three sums, one per column of the blocks, twice: six chains of additions.
void multiply(const BlockRows& K, const double* x, double* y) {
  for (int row = 0; row < K.rows; ++row) {
    Column sums[6] = {};
    const auto add = [&](int block, Column* sum) {
      const double *values = &K.values[9 * std::size_t(block)], *at = x + 3 * K.column[block];
      for (int j = 0; j < 3; ++j) sum[j] += load<Column>(values + 3 * j) * at[j];
    };
    int block = K.begin[row];
    for (; block + 1 < K.begin[row + 1]; block += 2) add(block, sums), add(block + 1, sums + 3);
    if (block < K.begin[row + 1]) add(block, sums);
    const Column sum = (sums[0] + sums[1]) + (sums[2] + sums[3]) + (sums[4] + sums[5]);
    for (int i = 0; i < 3; ++i) y[3 * row + i] = sum[i];
  }
}

}  // namespace

extern const MachineKernels kKernels;
const MachineKernels kKernels = {read, multiply_add, 2.0 * kChains* kLanes, multiply};

}  // namespace benchmarks::NURBS_SIMD_LEVEL
