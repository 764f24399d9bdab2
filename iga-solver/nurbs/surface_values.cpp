// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_values.h"

#include "nurbs/direction_functions.h"

namespace nurbs {
namespace {

// P is the degree of both directions, or 0 where they are known at run time only.

// R_ij = w_ij N_i M_j / W, W the sum of all w_ij N_i M_j.
template <int P>
void values(const Space<2>& space, const Parameter<2>& xi, SurfaceValues& out) {
  const int p = P > 0 ? P : space.degree(0), q = P > 0 ? P : space.degree(1);
  const DirectionFunctions<P, 0> u(space, 0, xi[0]);
  const DirectionFunctions<P, 0> v(space, 1, xi[1]);
  out.p = p, out.q = q, out.stride = space.control_point_count(0);
  out.first = u.first + out.stride * v.first;
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) out.R[i + (p + 1) * j] = u.N[0][i] * v.N[0][j];
  if (!space.rational()) return;
  const double* w = space.weights().data() + out.first;
  double W = 0.0;
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) W += out.R[i + (p + 1) * j] *= w[i + out.stride * j];
  const double inverse_W = 1.0 / W;
  for (int a = 0; a < (p + 1) * (q + 1); ++a) out.R[a] *= inverse_W;
}

// Control points of one row lie side by side.
template <int P>
void add(const SurfaceValues& v, const Vector3& F, double* __restrict f) {
  const int p = P > 0 ? P : v.p, q = P > 0 ? P : v.q;
  for (int j = 0; j <= q; ++j) {
    double* row = f + 3 * (v.first + v.stride * j);
    for (int i = 0; i <= p; ++i)
      for (int c = 0; c < 3; ++c) row[3 * i + c] += v.R[i + (p + 1) * j] * F[c];
  }
}

template <int P>
Vector3 sum(const SurfaceValues& v, const double* q_A) {
  const int p = P > 0 ? P : v.p, q = P > 0 ? P : v.q;
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
  with_degree(space.degree(0), space.degree(1), [&](auto P) { values<P>(space, xi, out); });
}

Vector3 interpolate(const SurfaceValues& v, const NodalVectors& q) {
  return with_degree(v.p, v.q, [&](auto P) { return sum<P>(v, q.data()); });
}

void distribute(const SurfaceValues& v, const Vector3& F, NodalVectors& f) {
  with_degree(v.p, v.q, [&](auto P) { add<P>(v, F, f.data()); });
}

}  // namespace nurbs
