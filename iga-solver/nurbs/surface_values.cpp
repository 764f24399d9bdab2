// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_values.h"

namespace nurbs {
namespace {

// P, Q are the degrees, or 0 where they are known at run time only.

// N_j = sum_k power[k][j] s^k; returns the index of the first.
template <int P>
[[gnu::always_inline]] inline int axis_values(const Space<2>& space, int direction, double xi, double* N) {
  const KnotVector& knots = space.knots(direction);
  const int p = P > 0 ? P : knots.degree(), e = knots.element_at(xi);
  const double begin = knots.breaks()[e], end = knots.breaks()[e + 1];
  const double s = xi <= begin ? -1.0 : xi >= end ? 1.0 : 2.0 * (xi - begin) / (end - begin) - 1.0;
  const auto& power = space.functions(direction, e).power;
  for (int j = 0; j <= p; ++j) N[j] = power[p][j];
  for (int k = p - 1; k >= 0; --k)
    for (int j = 0; j <= p; ++j) N[j] = N[j] * s + power[k][j];
  return knots.span_of_element(e) - p;
}

// R_ij = w_ij N_i M_j / W, W the sum of all w_ij N_i M_j.
template <int P, int Q>
void values(const Space<2>& space, const Parameter<2>& xi, SurfaceValues& out) {
  const int p = P > 0 ? P : space.degree(0), q = Q > 0 ? Q : space.degree(1);
  double N[kMaxDegree + 1], M[kMaxDegree + 1];
  out.p = p, out.q = q, out.stride = space.control_point_count(0);
  out.first = axis_values<P>(space, 0, xi[0], N) + out.stride * axis_values<Q>(space, 1, xi[1], M);
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) out.R[i + (p + 1) * j] = N[i] * M[j];
  if (!space.rational()) return;
  const double* w = space.weights().data() + out.first;
  double W = 0.0;
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) W += out.R[i + (p + 1) * j] *= w[i + out.stride * j];
  const double inverse_W = 1.0 / W;
  for (int a = 0; a < (p + 1) * (q + 1); ++a) out.R[a] *= inverse_W;
}

// Control points of one row lie side by side.
template <int P, int Q>
void add(const SurfaceValues& v, const Vector3& F, double* __restrict f) {
  const int p = P > 0 ? P : v.p, q = Q > 0 ? Q : v.q;
  for (int j = 0; j <= q; ++j) {
    double* row = f + 3 * (v.first + v.stride * j);
    for (int i = 0; i <= p; ++i)
      for (int c = 0; c < 3; ++c) row[3 * i + c] += v.R[i + (p + 1) * j] * F[c];
  }
}

template <int P, int Q>
Vector3 sum(const SurfaceValues& v, const double* q_A) {
  const int p = P > 0 ? P : v.p, q = Q > 0 ? Q : v.q;
  double total[3] = {0.0, 0.0, 0.0};
  for (int j = 0; j <= q; ++j) {
    const double* row = q_A + 3 * (v.first + v.stride * j);
    for (int i = 0; i <= p; ++i)
      for (int c = 0; c < 3; ++c) total[c] += v.R[i + (p + 1) * j] * row[3 * i + c];
  }
  return {total[0], total[1], total[2]};
}

}  // namespace

void evaluate_values(const Space<2>& space, const Parameter<2>& xi, SurfaceValues& out) {
  const int p = space.degree(0), q = space.degree(1);
  if (p == 2 && q == 2) return values<2, 2>(space, xi, out);
  if (p == 3 && q == 3) return values<3, 3>(space, xi, out);
  values<0, 0>(space, xi, out);
}

Vector3 interpolate(const SurfaceValues& v, const NodalVectors& q) {
  if (v.p == 2 && v.q == 2) return sum<2, 2>(v, q.data());
  if (v.p == 3 && v.q == 3) return sum<3, 3>(v, q.data());
  return sum<0, 0>(v, q.data());
}

void distribute(const SurfaceValues& v, const Vector3& F, NodalVectors& f) {
  if (v.p == 2 && v.q == 2) return add<2, 2>(v, F, f.data());
  if (v.p == 3 && v.q == 3) return add<3, 3>(v, F, f.data());
  add<0, 0>(v, F, f.data());
}

}  // namespace nurbs
