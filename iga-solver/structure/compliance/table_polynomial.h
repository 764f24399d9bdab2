// SPDX-License-Identifier: GPL-2.0-or-later
// Polynomials in two variables from -1 to 1, by their powers: [of t][of s].
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace structure {

/// Row k: coefficients of s^k of the polynomials that are 1 at one of the lobatto_points() and 0 at the
/// others.
Eigen::MatrixXd lobatto_powers(int count);

/// The value of one, and its derivatives.
struct TablePolynomial {
  TablePolynomial(const double* first, const std::array<int, 2>& counts, double s, double t) {
    const double* next = first + static_cast<std::ptrdiff_t>(counts[0]) * counts[1];
    for (int j = counts[1]; j > 0; --j) {
      double row = *--next, change = 0.0;
      for (int i = counts[0] - 1; i > 0; --i) {
        change = change * s + row;
        row = row * s + *--next;
      }
      by_t = by_t * t + value;
      value = value * t + row;
      by_s = by_s * t + change;
    }
  }
  double value = 0.0, by_s = 0.0, by_t = 0.0;
};

}  // namespace structure
