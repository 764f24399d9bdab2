// SPDX-License-Identifier: GPL-2.0-or-later
// Functions of one direction of a surface at a parameter, with derivatives, from their powers on the element:
// without the recursion of evaluate_basis() (basis.h).
#pragma once

#include <type_traits>

#include "nurbs/patch.h"

namespace nurbs {

/// `known`: the degree, or 0 where it is known at run time only.
template <int known, int derivatives>
struct DirectionFunctions {
  /// At xi, clamped to the domain.
  [[gnu::always_inline]] DirectionFunctions(const Space<2>& space, int direction, double xi) {
    const KnotVector& knots = space.knots(direction);
    const int p = known > 0 ? known : knots.degree(), e = knots.element_at(xi);
    const double begin = knots.breaks()[e], end = knots.breaks()[e + 1];
    const double s = xi <= begin ? -1.0 : xi >= end ? 1.0 : 2.0 * (xi - begin) / (end - begin) - 1.0;
    const auto& power = space.functions(direction, e).power;
    for (int j = 0; j <= p; ++j) N[0][j] = power[p][j];
    for (int d = 1; d <= derivatives; ++d)
      for (int j = 0; j <= p; ++j) N[d][j] = 0.0;
    for (int k = p - 1; k >= 0; --k)
      for (int j = 0; j <= p; ++j) {
        for (int d = derivatives; d > 0; --d) N[d][j] = N[d][j] * s + N[d - 1][j];
        N[0][j] = N[0][j] * s + power[k][j];
      }
    double scale = 1.0;
    for (int d = 1; d <= derivatives; ++d) {
      scale *= d * 2.0 / (end - begin);
      for (int j = 0; j <= p; ++j) N[d][j] *= scale;
    }
    first = knots.span_of_element(e) - p;
  }
  int first;                                  ///< control point that N[0][0] belongs to
  double N[derivatives + 1][kMaxDegree + 1];  ///< [derivative][function]
};

/// f(degree), a compile-time constant where both degrees are one of those in common use, else 0.
template <class Function>
decltype(auto) with_degree(int p, int q, Function f) {
  if (p == 2 && q == 2) return f(std::integral_constant<int, 2>());
  if (p == 3 && q == 3) return f(std::integral_constant<int, 3>());
  return f(std::integral_constant<int, 0>());
}

}  // namespace nurbs
