// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/basis.h"

#include <algorithm>
#include <cmath>

#include "nurbs/assert.h"

namespace nurbs {
namespace {

// Below, functions of degree q on the span [U_i, U_{i+1}] are numbered 0 .. q; function j starts at knot
// U_{i-q+j}. Both steps from degree q-1 to degree q need the quotients Q_j = N_j / (U_{i+1+j} - U_{i+1+j-q}),
// j = 0 .. q-1.
struct Quotients {
  double value[kMaxDegree + 2];  // value[j + 1] = Q_j, with zeros at both ends
  Quotients(const double* U, int i, int q, const double* N) {
    value[0] = value[q + 1] = 0.0;
    for (int j = 0; j < q; ++j) value[j + 1] = N[j] / (U[i + 1 + j] - U[i + 1 + j - q]);
  }
};

// Cox-de Boor: functions of degree q at xi from those of degree q-1 (Piegl & Tiller, eq. 2.5).
void raise_degree(const double* U, int i, int q, double xi, const double* lower, double* upper) {
  const Quotients Q(U, i, q, lower);
  upper[0] = (U[i + 1] - xi) * Q.value[1];
  for (int j = 1; j < q; ++j)
    upper[j] = (xi - U[i + j - q]) * Q.value[j] + (U[i + j + 1] - xi) * Q.value[j + 1];
  upper[q] = (xi - U[i]) * Q.value[q];
}

// Derivative of order k+1 of degree q from that of order k of degree q-1 (Piegl & Tiller, eq. 2.7).
void differentiate(const double* U, int i, int q, const double* lower, double* upper) {
  const Quotients Q(U, i, q, lower);
  for (int j = 0; j <= q; ++j) upper[j] = q * (Q.value[j] - Q.value[j + 1]);
}

}  // namespace

void evaluate_basis(const KnotVector& knots, int span, double xi, int derivatives, BasisFunctions& out) {
  const double* U = knots.knots().data();
  const int p = knots.degree();
  NURBS_ASSERT(p <= span && span < knots.control_point_count(), span, p, knots.control_point_count());
  NURBS_ASSERT(U[span] < U[span + 1], span, U[span], U[span + 1]);
  // Beyond its span the polynomial goes on; what is far from it was meant for another one.
  NURBS_ASSERT(std::abs(2.0 * xi - U[span] - U[span + 1]) <= 1.5 * (U[span + 1] - U[span]), xi, U[span],
               U[span + 1]);
  NURBS_ASSERT(0 <= derivatives && derivatives <= 2, derivatives);
  double N[kMaxDegree + 1][kMaxDegree + 1];  // N[q]: functions of degree q
  N[0][0] = 1.0;
  for (int q = 1; q < p; ++q) raise_degree(U, span, q, xi, N[q - 1], N[q]);

  out.first = span - p;
  raise_degree(U, span, p, xi, N[p - 1], out.values[0]);
  if (derivatives >= 1) differentiate(U, span, p, N[p - 1], out.values[1]);
  if (derivatives < 2) return;
  double first_derivative[kMaxDegree + 1] = {0.0, 0.0};  // of degree p-1; zero when that degree is 0
  if (p > 1) differentiate(U, span, p - 1, N[p - 2], first_derivative);
  differentiate(U, span, p, first_derivative, out.values[2]);
}

void evaluate_blossom(const KnotVector& knots, int span, const double* t, double* out) {
  NURBS_ASSERT(knots.degree() <= span && span < knots.control_point_count(), span, knots.degree());
  double lower[kMaxDegree + 1];
  out[0] = 1.0;
  for (int q = 1; q <= knots.degree(); ++q) {
    for (int j = 0; j < q; ++j) lower[j] = out[j];
    raise_degree(knots.knots().data(), span, q, t[q - 1], lower, out);
  }
}

double binomial(int n, int k) {
  NURBS_ASSERT(0 <= k && k <= n, n, k);
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

namespace {

// Monomial coefficients in s of the Bernstein polynomial C(p,k) ((1+s)/2)^k ((1-s)/2)^(p-k).
void bernstein_monomials(int p, int k, double* out) {
  std::fill_n(out, p + 1, 0.0);
  out[0] = binomial(p, k);
  for (int factor = 0; factor < p; ++factor) {
    const double sign = factor < k ? 1.0 : -1.0;
    for (int m = factor + 1; m > 0; --m) out[m] = 0.5 * (out[m] + sign * out[m - 1]);
    out[0] *= 0.5;
  }
}

void fill(const KnotVector& knots, int e, ElementFunctions& element) {
  const int p = knots.degree();
  const double begin = knots.breaks()[e], end = knots.breaks()[e + 1];
  for (auto& row : element.power) std::fill_n(row, kMaxDegree + 1, 0.0);
  for (int k = 0; k <= p; ++k) {
    double t[kMaxDegree] = {};
    for (int j = 0; j < p; ++j) t[j] = j < p - k ? begin : end;
    evaluate_blossom(knots, knots.span_of_element(e), t, element.bezier[k]);
    double monomials[kMaxDegree + 1];
    bernstein_monomials(p, k, monomials);
    for (int m = 0; m <= p; ++m)
      for (int j = 0; j <= p; ++j) element.power[m][j] += monomials[m] * element.bezier[k][j];
  }
}

}  // namespace

std::vector<ElementFunctions> element_functions(const KnotVector& knots) {
  std::vector<ElementFunctions> functions(knots.element_count());
  for (int e = 0; e < knots.element_count(); ++e) fill(knots, e, functions[e]);
  return functions;
}

}  // namespace nurbs
