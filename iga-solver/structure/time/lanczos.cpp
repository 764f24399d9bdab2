// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/lanczos.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace structure {

namespace {

/// Sum of the squares of the polynomials at x; -1 unless x lies above all Ritz values, where they are all
/// positive and rise.
double sum_of_squares(const Tridiagonal& T, double x) {
  double before = 0.0, p = 1.0, sum = 1.0;
  for (std::size_t j = 0; j < T.a.size(); ++j) {
    const double next = ((x - T.a[j]) * p - (j > 0 ? T.b[j - 1] : 0.0) * before) / T.b[j];
    if (!(next > 0.0)) return -1.0;
    before = p;
    p = next;
    sum += p * p;
  }
  return sum;
}

}  // namespace

double eigenvalue_bound(const Tridiagonal& T, double hidden) {
  const double wanted = 1.0 / (hidden * hidden);
  constexpr double kAccuracy = 1e-9;
  double low = *std::max_element(T.a.begin(), T.a.end());
  double width = std::max(*std::max_element(T.b.begin(), T.b.end()), kAccuracy * low);
  if (width == 0.0) return low;
  while (sum_of_squares(T, low + width) < wanted) width *= 2.0;
  double high = low + width;
  while (high - low > kAccuracy * high) {
    const double middle = 0.5 * (low + high);
    (sum_of_squares(T, middle) < wanted ? low : high) = middle;
  }
  return high;
}

double hidden_share(double norm, double chance) { return chance / (std::sqrt(2.0) * norm); }

}  // namespace structure
