// SPDX-License-Identifier: GPL-2.0-or-later
// Words of numbers, as long as the processor that a file is compiled for has them.  For files that are
// compiled once for each instruction set (add_simd_kernels in CMake): all is of internal linkage, since code
// for a newer processor must never be what the linker picks for all.
#pragma once

namespace nurbs::lanes {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 8;
#elif defined(__AVX2__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif

typedef double Lanes __attribute__((vector_size(8 * kLanes)));

[[gnu::always_inline]] inline Lanes load(const double* numbers) {  // of any alignment
  Lanes v;
  __builtin_memcpy(&v, numbers, sizeof v);
  return v;
}
/// The same into a register: else GCC 12 loads it anew for each product that it is used in, and loads are
/// what is waited for. Transposed contractions take 15 to 30 % less time.
[[gnu::always_inline]] inline Lanes load_once(const double* numbers) {
  Lanes v = load(numbers);
#if defined(__x86_64__)
  asm("" : "+v"(v));
#endif
  return v;
}
/// Has the processor fetch `count` numbers while the program goes on.
[[gnu::always_inline]] inline void prefetch(const double* numbers, int count) {
  for (int i = 0; i < count; i += 8) __builtin_prefetch(numbers + i);
}
[[gnu::always_inline]] inline void store(const Lanes& v, double* numbers) {
  __builtin_memcpy(numbers, &v, sizeof v);
}

}  // namespace
}  // namespace nurbs::lanes
