// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all (tests/iga-solver/check_symbols.py).
#include "structure/compliance/table_kernel.h"

namespace structure {
namespace {

using Four [[gnu::vector_size(FourPolynomials::kCount * sizeof(double))]] = double;

[[gnu::always_inline]] inline Four load(const double* from) {
  Four word;
  __builtin_memcpy(&word, from, sizeof word);
  return word;
}
[[gnu::always_inline]] inline void store(const Four& word, double* to) {
  __builtin_memcpy(to, &word, sizeof word);
}

// `known`: coefficients in both directions, or 0 where they are known at run time only.
template <int known>
[[gnu::always_inline]] inline void horner(const double* coefficients, int in_s, int in_t, double s, double t,
                                          FourPolynomials& out) {
  if (known > 0) in_s = in_t = known;
  const double* next = coefficients + FourPolynomials::kCount * in_s * in_t;
  Four value{}, by_s{}, by_t{};
  for (int j = in_t; j > 0; --j) {
    Four row = load(next -= FourPolynomials::kCount), change{};
    for (int i = in_s - 1; i > 0; --i) {
      change = change * s + row;
      row = row * s + load(next -= FourPolynomials::kCount);
    }
    by_t = by_t * t + value;
    value = value * t + row;
    by_s = by_s * t + change;
  }
  store(value, out.value), store(by_s, out.by_s), store(by_t, out.by_t);
}

// Who asks for a table in a time step finds it in memory, seldom in a cache.
void at_one_place(const double* coefficients, int in_s, int in_t, double s, double t, FourPolynomials& out) {
  constexpr int kLine = 64 / sizeof(double), kQuadratic = 5;
  const double* const end = coefficients + FourPolynomials::kCount * in_s * in_t;
  for (const double* line = coefficients; line < end; line += kLine) __builtin_prefetch(line);
  if (in_s == kQuadratic && in_t == kQuadratic)
    horner<kQuadratic>(coefficients, in_s, in_t, s, t, out);
  else
    horner<0>(coefficients, in_s, in_t, s, t, out);
}

}  // namespace

namespace NURBS_SIMD_LEVEL {
TableKernel table_kernel();
TableKernel table_kernel() { return at_one_place; }
}  // namespace NURBS_SIMD_LEVEL

}  // namespace structure
