// SPDX-License-Identifier: GPL-2.0-or-later
// Instruction sets that kernels are compiled for, and which of them is used on this machine.
#pragma once

namespace nurbs {

enum class SimdLevel {
  portable,  ///< what the compiler assumes anyway: on x86-64 SSE2, 2 numbers per word
  avx2,      ///< AVX2 and FMA: 4 numbers per word
  avx512     ///< AVX-512 F, DQ and VL: 8 numbers per word
};

const char* name(SimdLevel level);
/// Whether this machine can run it and it was compiled at all.
bool available(SimdLevel level);
/// The highest that is available, or that which the environment variable LIGGGHTS_NURBS_SIMD names (portable,
/// avx2, avx512).  Throws std::invalid_argument for other names and for one that is not available.
SimdLevel simd_level();

}  // namespace nurbs
