// SPDX-License-Identifier: GPL-2.0-or-later
// Logarithms in words; compiled once for each instruction set, as the kernels are.
#include "logarithm_words.h"

#include "nurbs/lanes.h"
#include "structure/material/logarithm.h"

namespace test::NURBS_SIMD_LEVEL {

void logarithms(int words, const double* J, const double* J_minus_1, double* value, double* excess,
                double* inverse) {
  using namespace nurbs::lanes;
  using namespace structure;
  for (int i = 0; i < words * 8; i += kLanes) {
    const Logarithm<Lanes> ln = logarithm(load(J + i), load(J_minus_1 + i));
    store(ln.value, value + i);
    store(ln.excess, excess + i);
    store(ln.inverse, inverse + i);
  }
}

}  // namespace test::NURBS_SIMD_LEVEL
