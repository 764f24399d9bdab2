// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace test {

/// Of 8 `words` numbers each.
using Logarithms = void (*)(int words, const double* J, const double* J_minus_1, double* value,
                            double* excess, double* inverse);
#define DECLARE_LOGARITHMS(level)                                                                     \
  namespace level {                                                                                   \
  void logarithms(int words, const double* J, const double* J_minus_1, double* value, double* excess, \
                  double* inverse);                                                                   \
  }
DECLARE_LOGARITHMS(portable)
DECLARE_LOGARITHMS(avx2)
DECLARE_LOGARITHMS(avx512)
#undef DECLARE_LOGARITHMS

}  // namespace test
