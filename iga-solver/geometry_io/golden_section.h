// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace geometry_io {

/// Where f is lowest on [a, b], in which it has one valley: golden sections (Kiefer 1953), to 4e-11 of b - a.
template <class F>
double golden_section(const F& f, double a, double b) {
  constexpr double kGolden = 0.61803398874989485;
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a), f_c = f(c), f_d = f(d);
  for (int i = 0; i < 50; ++i) {
    if (f_c < f_d) {
      b = d, d = c, f_d = f_c;
      c = b - kGolden * (b - a), f_c = f(c);
    } else {
      a = c, c = d, f_c = f_d;
      d = a + kGolden * (b - a), f_d = f(d);
    }
  }
  return 0.5 * (a + b);
}

}  // namespace geometry_io
