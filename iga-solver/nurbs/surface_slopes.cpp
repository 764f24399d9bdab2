// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/surface_slopes.h"

namespace nurbs {
namespace {

// P, Q are the degrees, or 0 where they are known at run time only.

/// Functions of one direction and their derivatives, from their powers on the element.
template <int P>
struct AxisSlopes {
  AxisSlopes(const Space<2>& space, int direction, double xi) {
    const KnotVector& knots = space.knots(direction);
    const int p = P > 0 ? P : knots.degree(), e = knots.element_at(xi);
    const double begin = knots.breaks()[e], end = knots.breaks()[e + 1], scale = 2.0 / (end - begin);
    const double s = xi <= begin ? -1.0 : xi >= end ? 1.0 : scale * (xi - begin) - 1.0;
    const auto& power = space.functions(direction, e).power;
    for (int j = 0; j <= p; ++j) N[j] = power[p][j], dN[j] = 0.0;
    for (int k = p - 1; k >= 0; --k)
      for (int j = 0; j <= p; ++j) {
        dN[j] = dN[j] * s + N[j];
        N[j] = N[j] * s + power[k][j];
      }
    for (int j = 0; j <= p; ++j) dN[j] *= scale;
    first = knots.span_of_element(e) - p;
  }
  int first;
  double N[kMaxDegree + 1], dN[kMaxDegree + 1];
};

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

template <int P, int Q>
void slopes(const Space<2>& space, const Parameter<2>& xi, SurfaceSlopes& out) {
  const int p = P > 0 ? P : space.degree(0), q = Q > 0 ? Q : space.degree(1);
  const AxisSlopes<P> u(space, 0, xi[0]);
  const AxisSlopes<Q> v(space, 1, xi[1]);
  SurfaceValues& values = out.values;
  values.p = p, values.q = q, values.stride = space.control_point_count(0);
  values.first = u.first + values.stride * v.first;
  for (int j = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i) {
      const int a = i + (p + 1) * j;
      values.R[a] = u.N[i] * v.N[j];
      out.dR[0][a] = u.dN[i] * v.N[j];
      out.dR[1][a] = u.N[i] * v.dN[j];
    }
  if (space.rational()) divide_by_weight(space.weights().data() + values.first, out);
}

// Control points of one row lie side by side.
template <int P, int Q>
void add(const SurfaceSlopes& s, const Vector3& F, const Tangents& G, double* __restrict f) {
  const int p = P > 0 ? P : s.values.p, q = Q > 0 ? Q : s.values.q;
  for (int j = 0; j <= q; ++j) {
    double* row = f + 3 * (s.values.first + s.values.stride * j);
    for (int i = 0; i <= p; ++i) {
      const int a = i + (p + 1) * j;
      for (int c = 0; c < 3; ++c)
        row[3 * i + c] += s.values.R[a] * F[c] + s.dR[0][a] * G(c, 0) + s.dR[1][a] * G(c, 1);
    }
  }
}

template <int P, int Q>
Tangents sum(const SurfaceSlopes& s, const double* q_A) {
  const int p = P > 0 ? P : s.values.p, q = Q > 0 ? Q : s.values.q;
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
  const int p = space.degree(0), q = space.degree(1);
  if (p == 2 && q == 2) return slopes<2, 2>(space, xi, out);
  if (p == 3 && q == 3) return slopes<3, 3>(space, xi, out);
  slopes<0, 0>(space, xi, out);
}

Tangents interpolate_slopes(const SurfaceSlopes& s, const NodalVectors& q) {
  if (s.values.p == 2 && s.values.q == 2) return sum<2, 2>(s, q.data());
  if (s.values.p == 3 && s.values.q == 3) return sum<3, 3>(s, q.data());
  return sum<0, 0>(s, q.data());
}

void distribute(const SurfaceSlopes& s, const Vector3& F, const Tangents& G, NodalVectors& f) {
  if (s.values.p == 2 && s.values.q == 2) return add<2, 2>(s, F, G, f.data());
  if (s.values.p == 3 && s.values.q == 3) return add<3, 3>(s, F, G, f.data());
  add<0, 0>(s, F, G, f.data());
}

}  // namespace nurbs
