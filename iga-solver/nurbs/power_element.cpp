// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/power_element.h"

#include <algorithm>
#include <cmath>

namespace nurbs {
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

void fill_matrices(const KnotVector& knots, int span, AxisElement& element) {
  const int p = knots.degree();
  for (auto& row : element.power) std::fill_n(row, p + 1, 0.0);
  for (int k = 0; k <= p; ++k) {
    double t[kMaxDegree];
    for (int j = 0; j < p; ++j) t[j] = j < p - k ? element.begin : element.end;
    evaluate_blossom(knots, span, t, element.bezier[k]);
    double monomials[kMaxDegree + 1];
    bernstein_monomials(p, k, monomials);
    for (int m = 0; m <= p; ++m)
      for (int j = 0; j <= p; ++j) element.power[m][j] += monomials[m] * element.bezier[k][j];
  }
}

// In what follows P, Q are the degrees, or 0 where they are known at run time only.

template <int P, int Q>
void transform(int p_given, int q_given, const double (*M0)[kMaxDegree + 1],
               const double (*M1)[kMaxDegree + 1], const Vector4* in, Vector4* out) {
  const int p = P > 0 ? P : p_given, q = Q > 0 ? Q : q_given;
  Vector4 half[P > 0 ? (P + 1) * (Q + 1) : power(kMaxDegree + 1, 2)];
  for (int j = 0; j <= q; ++j)
    for (int k = 0; k <= p; ++k) {
      Vector4 sum = M0[k][0] * in[(p + 1) * j];
      for (int i = 1; i <= p; ++i) sum += M0[k][i] * in[i + (p + 1) * j];
      half[k + (p + 1) * j] = sum;
    }
  for (int l = 0; l <= q; ++l)
    for (int k = 0; k <= p; ++k) {
      Vector4 sum = M1[l][0] * half[k];
      for (int j = 1; j <= q; ++j) sum += M1[l][j] * half[k + (p + 1) * j];
      out[k + (p + 1) * l] = sum;
    }
}

// Powers of s and their derivatives; those that vanish are never read.
template <int N>
struct Powers {
  double value[N + 1], first[N + 1], second[N + 1];
  Powers(int n, double s) {
    value[0] = 1.0;
    for (int k = 1; k <= n; ++k) value[k] = s * value[k - 1], first[k] = k * value[k - 1];
    for (int k = 2; k <= n; ++k) second[k] = k * first[k - 1];
  }
};

// sum_k factor[k] a[k stride] for k >= first, 0 if there is none.
inline Vector4 sum_from(int first, int n, const double* factor, const Vector4* a, int stride) {
  if (first > n) return Vector4::Zero();
  Vector4 sum = factor[first] * a[first * stride];
  for (int k = first + 1; k <= n; ++k) sum += factor[k] * a[k * stride];
  return sum;
}

inline double dot(const Vector4& a, const Vector4& b) { return (a * b).sum(); }

template <int P, int Q>
void evaluate(int p_given, int q_given, const Vector4* a, const double (&s)[2], const Vector4& d,
              DistanceJet& out) {
  const int p = P > 0 ? P : p_given, q = Q > 0 ? Q : q_given;
  constexpr int kP = P > 0 ? P : kMaxDegree, kQ = Q > 0 ? Q : kMaxDegree;
  const Powers<kP> u(p, s[0]);
  const Powers<kQ> v(q, s[1]);
  Vector4 row[kQ + 1], row_0[kQ + 1], row_00[kQ + 1];  // sums over i
  for (int j = 0; j == 0 || j <= q; ++j) {
    const Vector4* a_j = a + (p + 1) * j;
    row[j] = a_j[0] + sum_from(1, p, u.value, a_j, 1);
    row_0[j] = sum_from(1, p, u.first, a_j, 1);
    row_00[j] = sum_from(2, p, u.second, a_j, 1);
  }
  Vector4 S = row[0] + sum_from(1, q, v.value, row, 1);
  Vector4 S_0 = row_0[0] + sum_from(1, q, v.value, row_0, 1), S_1 = sum_from(1, q, v.first, row, 1);
  Vector4 S_00 = row_00[0] + sum_from(1, q, v.value, row_00, 1), S_01 = sum_from(1, q, v.first, row_0, 1),
          S_11 = sum_from(2, q, v.second, row, 1);

  if (d[3] != 0.0) {  // quotient rule; the fourth entries become 1, 0, 0, ...
    const double inverse_W = 1.0 / S[3], W_0 = S_0[3], W_1 = S_1[3];
    S *= inverse_W;
    S_00 = (S_00 - S_00[3] * S) * inverse_W;
    S_01 = (S_01 - S_01[3] * S) * inverse_W;
    S_11 = (S_11 - S_11[3] * S) * inverse_W;
    S_0 = (S_0 - W_0 * S) * inverse_W;
    S_1 = (S_1 - W_1 * S) * inverse_W;
    S_00 -= 2.0 * W_0 * inverse_W * S_0;
    S_01 -= inverse_W * (W_0 * S_1 + W_1 * S_0);
    S_11 -= 2.0 * W_1 * inverse_W * S_1;
  }

  out.r = S - d;
  out.S_i[0] = S_0, out.S_i[1] = S_1;
  out.phi = 0.5 * dot(out.r, out.r);
  out.gradient[0] = dot(out.r, S_0), out.gradient[1] = dot(out.r, S_1);
  out.metric[0] = dot(S_0, S_0), out.metric[1] = dot(S_0, S_1), out.metric[2] = dot(S_1, S_1);
  out.hessian[0] = out.metric[0] + dot(out.r, S_00);
  out.hessian[1] = out.metric[1] + dot(out.r, S_01);
  out.hessian[2] = out.metric[2] + dot(out.r, S_11);
}

}  // namespace

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

std::vector<AxisElement> axis_elements(const KnotVector& knots) {
  const std::vector<double>&breaks = knots.breaks(), &creases = knots.creases();
  std::vector<AxisElement> elements(knots.element_count());
  int crease = 0;
  for (int e = 0; e < knots.element_count(); ++e) {
    AxisElement& element = elements[e];
    element.begin = breaks[e], element.end = breaks[e + 1];
    element.half_width = 0.5 * (element.end - element.begin);
    if (element.begin >= creases[crease + 1]) ++crease;
    element.low = creases[crease] == element.begin ? -1.0 : element.local(creases[crease]);
    element.high = creases[crease + 1] == element.end ? 1.0 : element.local(creases[crease + 1]);
    element.first = knots.span_of_element(e) - knots.degree();
    element.at_end[0] = e == 0, element.at_end[1] = e + 1 == knots.element_count();
    fill_matrices(knots, knots.span_of_element(e), element);
  }
  return elements;
}

ElementKernel element_kernel(const Space<2>& space) {
  const int p = space.degree(0), q = space.degree(1);
  if (p == 2 && q == 2) return {p, q, transform<2, 2>, evaluate<2, 2>};
  if (p == 3 && q == 3) return {p, q, transform<3, 3>, evaluate<3, 3>};
  return {p, q, transform<0, 0>, evaluate<0, 0>};
}

}  // namespace nurbs
