// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_slopes.h"

#include "nurbs/direction_functions.h"

namespace nurbs {
namespace {

// P is the degree of both directions, or 0 where they are known at run time only.

// Of R = A / W: (A' - R W') / W.
void divide_by_weight(const double* w, SurfaceSlopes& out) {
  SurfaceValues& values = out.values;
  double W = 0.0, dW[2] = {0.0, 0.0};
  int a = 0;
  for (int j = 0; j <= values.q; ++j)
    for (int i = 0; i <= values.p; ++i, ++a) {
      const double weight = w[i + values.stride * j];
      W += values.R[a] *= weight;
      for (int d = 0; d < 2; ++d) dW[d] += out.dR[d][a] *= weight;
    }
  const double inverse = 1.0 / W;
  for (int k = 0; k < a; ++k) {
    values.R[k] *= inverse;
    for (int d = 0; d < 2; ++d) out.dR[d][k] = inverse * (out.dR[d][k] - values.R[k] * dW[d]);
  }
}

template <int P>
void slopes(const Space<2>& space, const Parameter<2>& xi, SurfaceSlopes& out) {
  const int p = P > 0 ? P : space.degree(0), q = P > 0 ? P : space.degree(1);
  const DirectionFunctions<P, 1> u(space, 0, xi[0]);
  const DirectionFunctions<P, 1> v(space, 1, xi[1]);
  SurfaceValues& values = out.values;
  values.p = p, values.q = q, values.stride = space.control_point_count(0);
  values.first = u.first + values.stride * v.first;
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) {
      const int a = i + (p + 1) * j;
      values.R[a] = u.N[0][i] * v.N[0][j];
      out.dR[0][a] = u.N[1][i] * v.N[0][j];
      out.dR[1][a] = u.N[0][i] * v.N[1][j];
    }
  if (space.rational()) divide_by_weight(space.weights().data() + values.first, out);
}

// Control points of one row lie side by side.
template <int P>
void add(const SurfaceSlopes& s, const Vector3& F, const Tangents& G, double* __restrict f) {
  const int p = P > 0 ? P : s.values.p, q = P > 0 ? P : s.values.q;
  for (int j = 0; j <= q; ++j) {
    double* row = f + 3 * (s.values.first + s.values.stride * j);
    for (int i = 0; i <= p; ++i) {
      const int a = i + (p + 1) * j;
      for (int c = 0; c < 3; ++c)
        row[3 * i + c] += s.values.R[a] * F[c] + s.dR[0][a] * G(c, 0) + s.dR[1][a] * G(c, 1);
    }
  }
}

template <int P>
Tangents sum(const SurfaceSlopes& s, const double* q_A) {
  const int p = P > 0 ? P : s.values.p, q = P > 0 ? P : s.values.q;
  double total[2][3] = {};
  for (int j = 0; j <= q; ++j) {
    const double* row = q_A + 3 * (s.values.first + s.values.stride * j);
    for (int i = 0; i <= p; ++i)
      for (int d = 0; d < 2; ++d)
        for (int c = 0; c < 3; ++c) total[d][c] += s.dR[d][i + (p + 1) * j] * row[3 * i + c];
  }
  return Tangents::Map(total[0]);
}

}  // namespace

void evaluate_slopes(const Space<2>& space, const Parameter<2>& xi, SurfaceSlopes& out) {
  with_degree(space.degree(0), space.degree(1), [&](auto P) { slopes<P>(space, xi, out); });
}

Tangents interpolate_slopes(const SurfaceSlopes& s, const NodalVectors& q) {
  return with_degree(s.values.p, s.values.q, [&](auto P) { return sum<P>(s, q.data()); });
}

void distribute(const SurfaceSlopes& s, const Vector3& F, const Tangents& G, NodalVectors& f) {
  with_degree(s.values.p, s.values.q, [&](auto P) { add<P>(s, F, G, f.data()); });
}

}  // namespace nurbs
