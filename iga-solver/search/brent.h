// SPDX-License-Identifier: GPL-2.0-or-later
// Brent's method for two equations f_0(x) = f_1(x) = 0 without derivatives: the equations are linearised one
// after the other, each where the one before has just been solved, so f_1 profits at once from f_0.
// Source: Brent (1973), "Some efficient algorithms for solving systems of nonlinear equations", SIAM J.
// Numer. Anal. 10; More & Cosnard (1979), "Numerical solution of nonlinear equations", ACM Trans. Math.
// Softw. 5 (Algorithm 554 repeats a sweep with old slopes; here each sweep has its own).
#pragma once

#include <Eigen/Core>

namespace search {

/// One iteration, in place: x moves to the nearest zero of the linear model of f_0 at x, then, along the
/// direction t in which that model stays zero, to the zero of the linear model of f_1.  Near a root with a
/// regular Jacobian the error is squared, until it is of order step.
/// f(j, x) is the value of equation j; step is the difference step, in the unit of x.
/// Returns false where a slope vanishes or a value is not finite: x is then of no use.
template <class Equations>
bool brent_sweep(const Equations& f, double step, Eigen::Vector2d& x) {
  const double f_0 = f(0, x);
  const Eigen::Vector2d gradient(f(0, x + step * Eigen::Vector2d::UnitX()) - f_0,
                                 f(0, x + step * Eigen::Vector2d::UnitY()) - f_0);
  const double slope_0 = gradient.norm() / step;
  // Brent's orthogonal transformation turns the first axis into f_0's gradient: for two unknowns, a rotation.
  const Eigen::Vector2d q = gradient.normalized(), t(-q[1], q[0]);
  x -= f_0 / slope_0 * q;

  const double f_1 = f(1, x);
  const double slope_1 = (f(1, x + step * t) - f_1) / step;
  x -= f_1 / slope_1 * t;
  return x.allFinite();
}

}  // namespace search
