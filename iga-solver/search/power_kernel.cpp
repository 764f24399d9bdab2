// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all (tests/iga-solver/check_symbols.py).
#include "search/power_kernel.h"

#include "search/power_newton.h"
#include "search/simd_words.h"

namespace search {

using nurbs::kMaxDegree;

namespace {

// The formulas are written once, on numbers (double or Lanes) and vectors (Vector4 or LaneVector).
// P, Q are the degrees, or 0 where they are known at run time only.

/// f, f', f''/2
template <class T>
struct Taylor {
  T f, f_u, half_f_uu;
};

/// Horner's rule for f(u) = sum_k a[k] u^k, n >= 1.
template <int N, class T, class Coefficients, class U>
[[gnu::always_inline]] inline Taylor<T> horner(int n_given, const Coefficients& a, const U& u) {
  const int n = N > 0 ? N : n_given;
  Taylor<T> t{multiply_add(u, a[n], a[n - 1]), a[n], T{}};
  if (n > 1) t = {multiply_add(u, t.f, a[n - 2]), multiply_add(u, a[n], t.f), a[n]};
  for (int k = n - 3; k >= 0; --k)
    t = {multiply_add(u, t.f, a[k]), multiply_add(u, t.f_u, t.f), multiply_add(u, t.half_f_uu, t.f_u)};
  return t;
}

/// sum_ij a[i + (p+1) j] u^i v^j and its derivatives.
template <int P, int Q, class T, class Coefficients, class U>
[[gnu::always_inline]] inline Derivatives<T> polynomial(int p_given, int q_given, const Coefficients& a,
                                                        const U& u, const U& v) {
  const int p = P > 0 ? P : p_given, q = Q > 0 ? Q : q_given;
  T f[(Q > 0 ? Q : kMaxDegree) + 1], f_u[(Q > 0 ? Q : kMaxDegree) + 1],
      half_f_uu[(Q > 0 ? Q : kMaxDegree) + 1];
  for (int j = 0; j <= q; ++j) {
    const Taylor<T> row = horner<P, T>(p, a + (p + 1) * j, u);
    f[j] = row.f, f_u[j] = row.f_u, half_f_uu[j] = row.half_f_uu;
  }
  const Taylor<T> S = horner<Q, T>(q, f, v), S_u = horner<Q, T>(q, f_u, v),
                  S_uu = horner<Q, T>(q, half_f_uu, v);
  return {S.f, S_u.f, S.f_u, 2.0 * S_uu.f, S_u.f_u, 2.0 * S.half_f_uu};
}

/// S - d = A / W - d and the derivatives: quotient rule (Piegl & Tiller 1997, eq. 4.20).
template <class Vector, class Number>
[[gnu::always_inline]] inline Derivatives<Vector> quotient(const Derivatives<Vector>& A,
                                                           const Derivatives<Number>& W, const Vector& d) {
  const Number inverse = 1.0 / W.f, W_0 = -inverse * W.f_0, W_1 = -inverse * W.f_1;
  const Vector S = inverse * A.f;
  Derivatives<Vector> r;
  r.f = S - d;
  r.f_0 = multiply_add(W_0, S, inverse * A.f_0);
  r.f_1 = multiply_add(W_1, S, inverse * A.f_1);
  r.f_00 = multiply_add(2.0 * W_0, r.f_0, inverse * multiply_add(-W.f_00, S, A.f_00));
  r.f_01 = multiply_add(W_0, r.f_1, multiply_add(W_1, r.f_0, inverse * multiply_add(-W.f_01, S, A.f_01)));
  r.f_11 = multiply_add(2.0 * W_1, r.f_1, inverse * multiply_add(-W.f_11, S, A.f_11));
  return r;
}

/// Numbers of a coefficient in a row.  What is read with the three of a polynomial patch means nothing.
template <bool Rational>
constexpr int kStride = Rational ? 4 : 3;

/// One element's surface seen from the point d: S - d.
template <int P, int Q, bool Rational>
struct Element {
  using Number = double;
  using Vector = Vector4;
  using Mask = bool;
  using Count = int;

  /// The coefficients; the constant one is kept apart, for a polynomial patch less d.
  struct Coefficients {
    Vector4 constant;
    const double* row;
    int first;

    [[gnu::always_inline]] Vector4 operator[](int k) const {
      return first + k == 0 ? constant : load(row + 4 + kStride<Rational> * (first + k));
    }
    [[gnu::always_inline]] Coefficients operator+(int k) const { return {constant, row, first + k}; }
  };

  int p, q;
  Coefficients a;
  Vector4 d;  // from the origin

  [[gnu::always_inline]] Element(int p, int q, const double* row, const Vector4& point)
      : p(p), q(q), d(point - load(row)) {
    a = {Rational ? load(row + 4) : load(row + 4) - d, row, 0};
  }
  double size() const { return a.row[3]; }
  [[gnu::always_inline]] Derivatives<Vector4> operator()(double u, double v) const {
    if constexpr (!Rational) {
      return polynomial<P, Q, Vector4>(p, q, a, u, v);
    } else {
      const Derivatives<Vector4> A = polynomial<P, Q, Vector4>(p, q, a, u, v);
      return quotient(A, Derivatives<double>{A.f[3], A.f_0[3], A.f_1[3], A.f_00[3], A.f_01[3], A.f_11[3]}, d);
    }
  }
};

/// The same of kLanes elements and points, one in each lane.
template <int P, int Q, bool Rational>
struct LaneElements {
  using Number = Lanes;
  using Vector = LaneVector;
  using Mask = LaneMask;
  using Count = LaneMask;
  static constexpr int kCoefficients = P > 0 ? (P + 1) * (Q + 1) : (kMaxDegree + 1) * (kMaxDegree + 1);

  int p, q;
  Lanes a[4][kCoefficients];  // x, y, z, W
  LaneVector d;
  Lanes row_size;

  [[gnu::always_inline]] LaneElements(int p, int q, const double* const* rows, const LaneVector& points)
      : p(p), q(q) {
    Vector4 numbers[kLanes];
    Lanes columns[4];
    for (int lane = 0; lane < kLanes; ++lane) numbers[lane] = load(rows[lane]);
    transpose(numbers, columns);
    d = points - LaneVector{columns[0], columns[1], columns[2]};
    row_size = columns[3];
    const int coefficients = P > 0 ? kCoefficients : (p + 1) * (q + 1);
    for (int k = 0; k < coefficients; ++k) {
      for (int lane = 0; lane < kLanes; ++lane) numbers[lane] = load(rows[lane] + 4 + kStride<Rational> * k);
      transpose(numbers, columns);
      for (int c = 0; c < kStride<Rational>; ++c) a[c][k] = columns[c];
    }
    if (!Rational) a[0][0] -= d.x, a[1][0] -= d.y, a[2][0] -= d.z;
  }
  const Lanes& size() const { return row_size; }
  [[gnu::always_inline]] Derivatives<LaneVector> operator()(const Lanes& u, const Lanes& v) const {
    const Derivatives<Lanes> x = polynomial<P, Q, Lanes>(p, q, a[0], u, v),
                             y = polynomial<P, Q, Lanes>(p, q, a[1], u, v),
                             z = polynomial<P, Q, Lanes>(p, q, a[2], u, v);
    const Derivatives<LaneVector> A{{x.f, y.f, z.f},          {x.f_0, y.f_0, z.f_0},
                                    {x.f_1, y.f_1, z.f_1},    {x.f_00, y.f_00, z.f_00},
                                    {x.f_01, y.f_01, z.f_01}, {x.f_11, y.f_11, z.f_11}};
    if constexpr (!Rational) return A;
    return quotient(A, polynomial<P, Q, Lanes>(p, q, a[3], u, v), d);
  }
};

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
      for (int i = 1; i <= p; ++i) sum = multiply_add(M0[k][i], row[i], sum);
      half[k + (p + 1) * j] = sum;
    }
  }
  for (int l = 0; l <= q; ++l)
    for (int k = 0; k <= p; ++k) {
      Vector4 sum = M1[l][0] * half[k];
      for (int j = 1; j <= q; ++j) sum = multiply_add(M1[l][j], half[k + (p + 1) * j], sum);
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
  for (int k = 0; k < (p + 1) * (q + 1); ++k) store(a[k], row + 4 + kStride<Rational> * k);
}

template <int P, int Q, bool Rational>
void evaluate(int p, int q, const double* element, const double (&s)[2], const double (&d)[3],
              DistanceJet& out) {
  const Element<P, Q, Rational> surface(p, q, element, load3(d));
  const Derivatives<Vector4> S = surface(s[0], s[1]);
  const Vector4& r = S.f;
  const double metric[] = {dot(S.f_0, S.f_0), dot(S.f_0, S.f_1), dot(S.f_1, S.f_1)},
               bend[] = {dot(r, S.f_00), dot(r, S.f_01), dot(r, S.f_11)};
  out.phi = 0.5 * dot(r, r);
  out.gradient[0] = dot(r, S.f_0), out.gradient[1] = dot(r, S.f_1);
  for (int i = 0; i < 3; ++i) {
    out.metric[i] = metric[i], out.hessian[i] = metric[i] + bend[i];
    out.r[i] = r[i], out.S_i[0][i] = S.f_0[i], out.S_i[1][i] = S.f_1[i];
    out.S_ij[0][i] = S.f_00[i], out.S_ij[1][i] = S.f_01[i], out.S_ij[2][i] = S.f_11[i];
  }
}

template <int P, int Q, bool Rational>
void newton(int p, int q, const double* element, const double* point, double s0, double s1, NewtonEnd& end) {
  const Vector4 d = load3(point);
  const Element<P, Q, Rational> surface(p, q, element, d);
  double s[2] = {s0, s1};
  const auto foot = newton(surface, s);
  store(with_fourth(d + foot.r, __builtin_sqrt(foot.distance2)), end.foot);  // and the distance
  for (int i = 0; i < 2; ++i) end.s[i] = foot.s[i], end.next[i] = foot.next[i];
  end.iterations = foot.iterations;
  end.done = foot.done;
}

/// In one direction, from number `first` on: the elements of parameters.  Returns where they are the right
/// ones.
[[gnu::always_inline]] inline LaneMask locate(const AxisNumbers& axis, const Lanes& xi, int i, int first,
                                              NewtonBatch& batch, LaneIndices& e) {
  const Lanes place = larger((xi - axis.front) * axis.elements_per_length, Lanes{}),
              last = axis.last + Lanes{};
  e = __builtin_convertvector(place < last ? place : last, LaneIndices);
  Vector4 rows[kLanes];
  Lanes numbers[4];
  for (int lane = 0; lane < kLanes; ++lane) rows[lane] = load(axis.elements + 8 * e[lane]);
  transpose(rows, numbers);
  const Lanes &begin = numbers[0], &end = numbers[1], &per_half_width = numbers[3];
  store(begin, batch.begin[i] + first);
  store(end, batch.end[i] + first);
  store(numbers[2], batch.half_width[i] + first);
  store((xi - begin) * per_half_width - 1.0, batch.s[i] + first);
  return begin <= xi && xi < end;
}

void locate(NewtonBatch& batch) {
  for (int k = batch.count; k % kLanes != 0; ++k)  // lanes not used repeat the first point
    for (auto& xi : batch.xi) xi[k] = xi[0];
  const auto n = static_cast<int>(batch.axes[0]->last) + 1;
  for (int first = 0; first < batch.count; first += kLanes) {
    LaneIndices e[2];
    LaneMask right{};
    for (int i = 0; i < 2; ++i) {
      const LaneMask here = locate(*batch.axes[i], load_lanes(batch.xi[i] + first), i, first, batch, e[i]);
      right = i == 0 ? here : right && here;
    }
    store(e[0] + n * e[1], batch.element + first);
    if (any(!right))
      for (int lane = 0; lane < kLanes; ++lane)
        if (!right[lane]) batch.element[first + lane] = -1;
  }
}

/// Parameters of feet, and on how many ends of the patch they lie.
[[gnu::always_inline]] inline void take_parameters(const Lanes (&s)[2], int first, NewtonBatch& batch) {
  LaneMask borders{};
  for (int i = 0; i < 2; ++i) {
    const Lanes end = load_lanes(batch.end[i] + first),
                inside = load_lanes(batch.begin[i] + first) +
                         load_lanes(batch.half_width[i] + first) * (1.0 + s[i]),
                xi = end < inside ? end : inside;
    borders += count(xi <= batch.axes[i]->front || batch.axes[i]->back <= xi);
    store(xi, batch.xi[i] + first);
  }
  store(borders, batch.borders + first);
}

template <int P, int Q, bool Rational>
void newton_batch(int p, int q, NewtonBatch& batch) {
  for (int k = batch.count; k % kLanes != 0; ++k) {  // lanes not used repeat the first point
    batch.row[k] = batch.row[0];
    for (auto& d : batch.d) d[k] = d[0];
    for (auto& s : batch.s) s[k] = s[0];
  }
  for (int first = 0; first < batch.count; first += kLanes) {
    const LaneVector d{load_lanes(batch.d[0] + first), load_lanes(batch.d[1] + first),
                       load_lanes(batch.d[2] + first)};
    const LaneElements<P, Q, Rational> surface(p, q, batch.row + first, d);
    Lanes s[2] = {load_lanes(batch.s[0] + first), load_lanes(batch.s[1] + first)};
    const auto foot = newton(surface, s);
    store(foot.done, batch.done + first);
    store(foot.iterations, batch.iterations + first);
    for (int i = 0; i < 2; ++i)
      store(foot.s[i], batch.s[i] + first), store(foot.next[i], batch.next[i] + first);
    store(d.x + foot.r.x, batch.foot[0] + first);
    store(d.y + foot.r.y, batch.foot[1] + first);
    store(d.z + foot.r.z, batch.foot[2] + first);
    store(root(foot.distance2), batch.distance + first);
    take_parameters(foot.s, first, batch);
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
          newton_batch<P, Q, Rational>,
          locate};
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

}  // namespace search
