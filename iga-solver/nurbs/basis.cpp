// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/basis.h"

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
  double lower[kMaxDegree + 1];
  out[0] = 1.0;
  for (int q = 1; q <= knots.degree(); ++q) {
    for (int j = 0; j < q; ++j) lower[j] = out[j];
    raise_degree(knots.knots().data(), span, q, t[q - 1], lower, out);
  }
}

}  // namespace nurbs
