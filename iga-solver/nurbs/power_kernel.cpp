// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all (tests/iga-solver/nurbs/check_symbols.py).
#include "nurbs/power_kernel.h"

#include "nurbs/simd_words.h"

namespace nurbs {
namespace {

// The formulas are written once, on numbers (double or Lanes) and vectors (Vector4 or LaneVector).
// P, Q are the degrees, or 0 where they are known at run time only.

/// f, f', f''/2
template <class T>
struct Taylor {
  T f, f_u, half_f_uu;
};

/// Horner's rule for f(u) = sum_k a[k] u^k, n >= 1.
template <int N, class T, class U>
[[gnu::always_inline]] inline Taylor<T> horner(int n_given, const T* a, const U& u) {
  const int n = N > 0 ? N : n_given;
  Taylor<T> t{u * a[n] + a[n - 1], a[n], T{}};
  if (n > 1) t = {u * t.f + a[n - 2], u * a[n] + t.f, a[n]};
  for (int k = n - 3; k >= 0; --k) t = {u * t.f + a[k], u * t.f_u + t.f, u * t.half_f_uu + t.f_u};
  return t;
}

template <class T>
struct Derivatives {
  T f, f_0, f_1, f_00, f_01, f_11;
};

/// sum_ij a[i + (p+1) j] u^i v^j and its derivatives.
template <int P, int Q, class T, class U>
[[gnu::always_inline]] inline Derivatives<T> polynomial(int p_given, int q_given, const T* a, const U& u,
                                                        const U& v) {
  const int p = P > 0 ? P : p_given, q = Q > 0 ? Q : q_given;
  T f[(Q > 0 ? Q : kMaxDegree) + 1], f_u[(Q > 0 ? Q : kMaxDegree) + 1],
      half_f_uu[(Q > 0 ? Q : kMaxDegree) + 1];
  for (int j = 0; j <= q; ++j) {
    const Taylor<T> row = horner<P>(p, a + (p + 1) * j, u);
    f[j] = row.f, f_u[j] = row.f_u, half_f_uu[j] = row.half_f_uu;
  }
  const Taylor<T> S = horner<Q>(q, f, v), S_u = horner<Q>(q, f_u, v), S_uu = horner<Q>(q, half_f_uu, v);
  return {S.f, S_u.f, S.f_u, 2.0 * S_uu.f, S_u.f_u, 2.0 * S.half_f_uu};
}

/// S = A / W and its derivatives: quotient rule (Piegl & Tiller 1997, eq. 4.20).
template <class Vector, class Number>
[[gnu::always_inline]] inline Derivatives<Vector> quotient(const Derivatives<Vector>& A,
                                                           const Derivatives<Number>& W) {
  const Number inverse = 1.0 / W.f, W_0 = inverse * W.f_0, W_1 = inverse * W.f_1;
  Derivatives<Vector> S;
  S.f = inverse * A.f;
  S.f_0 = inverse * A.f_0 - W_0 * S.f;
  S.f_1 = inverse * A.f_1 - W_1 * S.f;
  S.f_00 = inverse * (A.f_00 - W.f_00 * S.f) - 2.0 * W_0 * S.f_0;
  S.f_01 = inverse * (A.f_01 - W.f_01 * S.f) - W_0 * S.f_1 - W_1 * S.f_0;
  S.f_11 = inverse * (A.f_11 - W.f_11 * S.f) - 2.0 * W_1 * S.f_1;
  return S;
}

/// The surface of one element.
template <int P, int Q, bool Rational>
struct Element {
  using Number = double;
  using Vector = Vector4;
  using Mask = bool;
  using Count = int;

  int p, q;
  const Vector4* row;

  Vector4 origin() const { return row[0]; }
  double size() const { return row[0][3]; }
  [[gnu::always_inline]] Derivatives<Vector4> operator()(double u, double v) const {
    const Derivatives<Vector4> A = polynomial<P, Q>(p, q, row + 1, u, v);
    if (!Rational) return A;
    const Derivatives<double> W{A.f[3], A.f_0[3], A.f_1[3], A.f_00[3], A.f_01[3], A.f_11[3]};
    return quotient(A, W);
  }
};

/// The surfaces of kLanes elements, one in each lane.
template <int P, int Q, bool Rational>
struct LaneElements {
  using Number = Lanes;
  using Vector = LaneVector;
  using Mask = LaneMask;
  using Count = LaneMask;
  static constexpr int kCoefficients = P > 0 ? (P + 1) * (Q + 1) : (kMaxDegree + 1) * (kMaxDegree + 1);

  int p, q;
  Lanes a[4][kCoefficients];  // x, y, z, W

  [[gnu::always_inline]] Derivatives<LaneVector> operator()(const Lanes& u, const Lanes& v) const {
    const Derivatives<Lanes> x = polynomial<P, Q>(p, q, a[0], u, v), y = polynomial<P, Q>(p, q, a[1], u, v),
                             z = polynomial<P, Q>(p, q, a[2], u, v);
    const Derivatives<LaneVector> A{{x.f, y.f, z.f},          {x.f_0, y.f_0, z.f_0},
                                    {x.f_1, y.f_1, z.f_1},    {x.f_00, y.f_00, z.f_00},
                                    {x.f_01, y.f_01, z.f_01}, {x.f_11, y.f_11, z.f_11}};
    if constexpr (!Rational) return A;
    return quotient(A, polynomial<P, Q>(p, q, a[3], u, v));
  }
};

template <class Number, class Vector>
struct Jet {
  Number phi, g[2], A[3], H[3];  // as in DistanceJet
  Vector r, S_i[2];
};

template <class Surface>
[[gnu::always_inline]] inline Jet<typename Surface::Number, typename Surface::Vector> jet(
    const Surface& surface, const typename Surface::Number (&s)[2], const typename Surface::Vector& d) {
  const Derivatives<typename Surface::Vector> S = surface(s[0], s[1]);
  const typename Surface::Vector r = S.f - d;
  const typename Surface::Number A[3] = {dot(S.f_0, S.f_0), dot(S.f_0, S.f_1), dot(S.f_1, S.f_1)};
  return {0.5 * dot(r, r),
          {dot(r, S.f_0), dot(r, S.f_1)},
          {A[0], A[1], A[2]},
          {A[0] + dot(r, S.f_00), A[1] + dot(r, S.f_01), A[2] + dot(r, S.f_11)},
          r,
          {S.f_0, S.f_1}};
}

template <class Surface>
struct Foot {
  typename Surface::Number s[2];
  typename Surface::Vector r;
  typename Surface::Count iterations;
  typename Surface::Mask done;
};

/// Newton's method from s in all lanes; a lane that needs more than full steps inside its element drops out.
template <class Surface>
[[gnu::always_inline]] inline Foot<Surface> newton(const Surface& surface, typename Surface::Number (&s)[2],
                                                   const typename Surface::Vector& d,
                                                   const typename Surface::Number& size) {
  using Number = typename Surface::Number;
  using Mask = typename Surface::Mask;
  constexpr int kMaxIterations = 8;

  Number step[2]{}, to[2] = {s[0], s[1]};
  Number phi{}, allowed{};  // where the step began; what Armijo asks for where it ends
  typename Surface::Count iterations{};
  Mask active = larger(absolute(s[0]), absolute(s[1])) < 1.0, done{};
  Jet<Number, typename Surface::Vector> f;
  for (int iteration = 1;; ++iteration) {
    f = jet(surface, to, d);
    if (iteration > 1) {
      const Number excess = f.phi - allowed;
      active = active &&
               (excess <= 0.0 || square(excess) < 2.0 * phi * square(kRoundOff) * (2.0 * phi + square(size)));
      if (!any(active)) break;
      s[0] = active ? to[0] : s[0];
      s[1] = active ? to[1] : s[1];
    }
    const Number(&g)[2] = f.g, (&A)[3] = f.A, (&H)[3] = f.H;
    const Number det = H[0] * H[2] - H[1] * H[1], inverse = 1.0 / det;
    step[0] = (H[1] * g[1] - H[2] * g[0]) * inverse;  // -H^-1 g
    step[1] = (H[1] * g[0] - H[0] * g[1]) * inverse;
    to[0] = s[0] + step[0];
    to[1] = s[1] + step[1];
    active = active && H[0] > kLeastCurvature * A[0] && H[2] > kLeastCurvature * A[2] &&
             det > kLeastCurvature * (H[0] * H[2]) && larger(absolute(to[0]), absolute(to[1])) < kWellInside;
    if (!any(active)) break;
    iterations += count(active);

    // det H / (A_00 A_11) is the curvature of phi where a plane has 1.
    const Number length = larger(absolute(step[0]), absolute(step[1]));
    const Mask last = length <= kLastStep && length * (A[0] * A[2]) <= kLastStep * det;
    if (any(last)) {
      const Number pole2 = square(kPole * size);
      done = done || (active && last && A[0] > pole2 && A[2] > pole2);
      active = active && !last;
      if (!any(active)) break;
    }
    if (iteration == kMaxIterations) break;
    to[0] = active ? to[0] : s[0];
    to[1] = active ? to[1] : s[1];
    phi = f.phi;
    allowed = phi + kDecrease * (g[0] * step[0] + g[1] * step[1]);
  }
  // The last step is too short for S to need more than its tangents.
  const Number zero{};
  const Number end[2] = {done ? step[0] : zero, done ? step[1] : zero};
  return {{s[0] + end[0], s[1] + end[1]}, f.r + end[0] * f.S_i[0] + end[1] * f.S_i[1], iterations, done};
}

template <int P, int Q, bool Rational>
[[gnu::always_inline]] inline void transform_net(int p, int q, const ElementKernel::Matrix* M0,
                                                 const ElementKernel::Matrix* M1, const ElementNet& net,
                                                 Vector4* out) {
  constexpr double kFourth[] = {0.0, 0.0, 0.0, 1.0};
  const Vector4 origin = load3(net.origin), fourth = load(kFourth);
  Vector4 half[P > 0 ? (P + 1) * (Q + 1) : (kMaxDegree + 1) * (kMaxDegree + 1)];
  for (int j = 0; j <= q; ++j) {
    Vector4 row[(P > 0 ? P : kMaxDegree) + 1];
    for (int i = 0; i <= p; ++i) {
      const int c = i + net.stride * j;
      row[i] = load3(net.points + 3 * c) - origin;
      if (Rational) row[i] = net.weights[c] * (row[i] + fourth);
    }
    for (int k = 0; k <= p; ++k) {
      Vector4 sum = M0[k][0] * row[0];
      for (int i = 1; i <= p; ++i) sum = sum + M0[k][i] * row[i];
      half[k + (p + 1) * j] = sum;
    }
  }
  for (int l = 0; l <= q; ++l)
    for (int k = 0; k <= p; ++k) {
      Vector4 sum = M1[l][0] * half[k];
      for (int j = 1; j <= q; ++j) sum = sum + M1[l][j] * half[k + (p + 1) * j];
      out[k + (p + 1) * l] = sum;
    }
}

template <int P, int Q, bool Rational>
void transform(int p_given, int q_given, const ElementKernel::Matrix* M0, const ElementKernel::Matrix* M1,
               const ElementNet& net, double* out) {
  const int p = P > 0 ? P : p_given, q = Q > 0 ? Q : q_given;
  Vector4 a[P > 0 ? (P + 1) * (Q + 1) : (kMaxDegree + 1) * (kMaxDegree + 1)];
  transform_net<P, Q, Rational>(p, q, M0, M1, net, a);
  for (int k = 0; k < (p + 1) * (q + 1); ++k) store(a[k], out + 4 * k);
}

template <int P, int Q, bool Rational>
void build(int p_given, int q_given, const ElementKernel::Matrix* M0, const ElementKernel::Matrix* M1,
           const ElementNet& net, double* row) {
  const int p = P > 0 ? P : p_given, q = Q > 0 ? Q : q_given;
  Vector4 a[P > 0 ? (P + 1) * (Q + 1) : (kMaxDegree + 1) * (kMaxDegree + 1)];
  transform_net<P, Q, Rational>(p, q, M0, M1, net, a);
  Vector4 extent = absolute(a[0]);
  for (int k = 1; k < (p + 1) * (q + 1); ++k) extent = extent + absolute(a[k]);
  const double size = extent[0] + extent[1] + extent[2];
  store(load3(net.origin), row);
  row[3] = Rational ? size / a[0][3] : size;
  for (int k = 0; k < (p + 1) * (q + 1); ++k) store(a[k], row + 4 * (k + 1));
}

template <int P, int Q, bool Rational>
void evaluate(int p, int q, const double* element, const double (&s)[2], const double (&d)[3],
              DistanceJet& out) {
  const Element<P, Q, Rational> surface{p, q, reinterpret_cast<const Vector4*>(element)};
  const auto f = jet(surface, s, load3(d) - surface.origin());
  out.phi = f.phi;
  for (int i = 0; i < 2; ++i) out.gradient[i] = f.g[i];
  for (int i = 0; i < 3; ++i) {
    out.metric[i] = f.A[i], out.hessian[i] = f.H[i];
    out.r[i] = f.r[i], out.S_i[0][i] = f.S_i[0][i], out.S_i[1][i] = f.S_i[1][i];
  }
}

template <int P, int Q, bool Rational>
void newton(int p, int q, NewtonPoint& point) {
  const Element<P, Q, Rational> surface{p, q, reinterpret_cast<const Vector4*>(point.element)};
  double s[2] = {point.s[0], point.s[1]};
  const auto foot = newton(surface, s, load3(point.d) - surface.origin(), surface.size());
  point.done = foot.done;
  point.iterations = foot.iterations;
  for (int i = 0; i < 2; ++i) point.s[i] = foot.s[i];
  store(foot.r, point.r);
}

template <int P, int Q, bool Rational>
void newton_batch(int p, int q, NewtonPoint* points, int count) {
  LaneElements<P, Q, Rational> surface;
  surface.p = p, surface.q = q;
  const int coefficients = P > 0 ? (P + 1) * (Q + 1) : (p + 1) * (q + 1);
  for (; count > 0; points += kLanes, count -= kLanes) {
    const int used = count < kLanes ? count : kLanes;
    const double* elements[kLanes];
    Vector4 rows[kLanes];
    Lanes s[2] = {}, d[4], a[4];
    for (int lane = 0; lane < kLanes; ++lane) {
      const NewtonPoint& point = points[lane < used ? lane : 0];  // unused lanes repeat the first
      elements[lane] = point.element;
      rows[lane] = load3(point.d) - load(point.element);
      s[0][lane] = point.s[0], s[1][lane] = point.s[1];
    }
    transpose(rows, d);
    const Lanes size = -d[3];
    for (int k = 0; k < coefficients; ++k) {
      for (int lane = 0; lane < kLanes; ++lane) rows[lane] = load(elements[lane] + 4 * (k + 1));
      transpose(rows, a);
      for (int c = 0; c < (Rational ? 4 : 3); ++c) surface.a[c][k] = a[c];
    }
    const auto foot = newton(surface, s, {d[0], d[1], d[2]}, size);
    for (int lane = 0; lane < used; ++lane) {
      NewtonPoint& point = points[lane];
      point.done = foot.done[lane] != 0;
      point.iterations = static_cast<int>(foot.iterations[lane]);
      for (int i = 0; i < 2; ++i) point.s[i] = foot.s[i][lane];
      point.r[0] = foot.r.x[lane], point.r[1] = foot.r.y[lane], point.r[2] = foot.r.z[lane];
    }
  }
}

template <int P, int Q, bool Rational>
ElementKernel kernel(int p, int q) {
  return {p,
          q,
          transform<P, Q, Rational>,
          build<P, Q, Rational>,
          evaluate<P, Q, Rational>,
          newton<P, Q, Rational>,
          newton_batch<P, Q, Rational>};
}

template <bool Rational>
ElementKernel kernel_of_degrees(int p, int q) {
  if (p == 2 && q == 2) return kernel<2, 2, Rational>(p, q);
  if (p == 3 && q == 3) return kernel<3, 3, Rational>(p, q);
  return kernel<0, 0, Rational>(p, q);
}

}  // namespace

namespace NURBS_SIMD_LEVEL {
ElementKernel element_kernel(int p, int q, bool rational);
ElementKernel element_kernel(int p, int q, bool rational) {
  return rational ? kernel_of_degrees<true>(p, q) : kernel_of_degrees<false>(p, q);
}
}  // namespace NURBS_SIMD_LEVEL

}  // namespace nurbs
