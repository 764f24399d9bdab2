// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all.
#include "structure/sweep/line_kernel.h"

#include <algorithm>
#include <utility>

#include "nurbs/lanes.h"

namespace structure {

using namespace nurbs::lanes;

namespace {

/// Functions at some points, B or dB, in registers.
template <int P, int Points>
struct PointBasis {
  Lanes of[Points][P + 1];
};
/// Of one knot span, for a direction across words: the same in all lanes.
template <int P, int Points>
[[gnu::always_inline]] inline PointBasis<P, Points> of_span(const double* basis, int derivative) {
  PointBasis<P, Points> B;
  for (int q = 0; q < Points; ++q)
    for (int a = 0; a <= P; ++a) B.of[q][a] = Lanes{} + basis[(2 * q + derivative) * (P + 1) + a];
  return B;
}
/// Of a word of spans, for the direction along it.
template <int P, int Points>
[[gnu::always_inline]] inline PointBasis<P, Points> of_word(const double* basis, int derivative) {
  PointBasis<P, Points> B;
  for (int q = 0; q < Points; ++q)
    for (int a = 0; a <= P; ++a) B.of[q][a] = load(basis + ((2 * q + derivative) * (P + 1) + a) * kLanes);
  return B;
}

/// Sums over control values, to points `point` apart.
template <int P, int Points>
[[gnu::always_inline]] inline void to(const PointBasis<P, Points>& B, const Lanes (&value)[P + 1],
                                      double* out, std::size_t point) {
  for (int q = 0; q < Points; ++q) {
    Lanes sum = B.of[q][0] * value[0];
    for (int a = 1; a <= P; ++a) sum += B.of[q][a] * value[a];
    store(sum, out + q * point);
  }
}
/// The same of control values `step` apart.
template <int P, int Points>
[[gnu::always_inline]] inline void to(const PointBasis<P, Points>& B, const double* u, std::size_t step,
                                      double* out, std::size_t point) {
  Lanes value[P + 1];
  for (int a = 0; a <= P; ++a) value[a] = load(u + a * step);
  to(B, value, out, point);
}
/// Transposed: added to the first `begun` of them, the others are overwritten.
template <int P, int Points>
[[gnu::always_inline]] inline void from(const PointBasis<P, Points>& B, const double* t, std::size_t point,
                                        int begun, double* f, std::size_t step) {
  Lanes value[Points];
  for (int q = 0; q < Points; ++q) value[q] = load_once(t + q * point);
  for (int a = 0; a <= P; ++a) {
    Lanes sum = a < begun ? load(f + a * step) : Lanes{};
    for (int q = 0; q < Points; ++q) sum += B.of[q][a] * value[q];
    store(sum, f + a * step);
  }
}

/// with(number of points); spans have p - 1, p or p + 1 (quadrature.h).
template <int P, class With>
[[gnu::always_inline]] inline void with_points(int points, const With& with) {
  if (points == P + 1)
    with(std::integral_constant<int, P + 1>());
  else if (points == P)
    with(std::integral_constant<int, P>());
  else
    with(std::integral_constant<int, P - 1>());
}

// Planes come from the second-level cache: each is read once, for B and dB.

template <int P>
void to_planes(const SpanBasis& z, const double* nodes, std::size_t plane, std::size_t field, int fields,
               double* planes) {
  const std::size_t point = 2 * std::size_t(fields) * plane;
  with_points<P>(
      z.points, [&](auto points) __attribute__((always_inline)) {
        const auto B = of_span<P, points>(z.basis, 0), dB = of_span<P, points>(z.basis, 1);
        for (int c = 0; c < fields; ++c)
          for (std::size_t i = 0; i < plane; i += kLanes) {
            Lanes value[P + 1];
            for (int a = 0; a <= P; ++a) value[a] = load(nodes + c * field + a * plane + i);
            to(B, value, planes + 2 * c * plane + i, point);
            to(dB, value, planes + (2 * c + 1) * plane + i, point);
          }
      });
}

template <int P>
void from_planes(const SpanBasis& z, const double* planes, std::size_t plane, std::size_t field, int fields,
                 double* nodes) {
  const std::size_t point = 2 * std::size_t(fields) * plane;
  with_points<P>(
      z.points, [&](auto points) __attribute__((always_inline)) {
        const auto B = of_span<P, points>(z.basis, 0), dB = of_span<P, points>(z.basis, 1);
        for (int c = 0; c < fields; ++c)
          for (std::size_t i = 0; i < plane; i += kLanes) {
            double* const f = nodes + c * field + i;
            from(B, planes + 2 * c * plane + i, point, z.begun, f, plane);
            from(dB, planes + (2 * c + 1) * plane + i, point, P + 1, f, plane);
          }
      });
}

// Rows and points: B for all that it is needed for, then dB: one of them has room in the registers.

template <int P>
void to_rows(const SpanBasis& y, const double* planes, std::size_t row, std::size_t plane, int fields,
             double* rows) {
  const std::size_t point = 3 * std::size_t(fields) * row;
  with_points<P>(
      y.points, [&](auto points) __attribute__((always_inline)) {
        const auto B = of_span<P, points>(y.basis, 0);
        for (int c = 0; c < fields; ++c)
          for (std::size_t i = 0; i < row; i += kLanes) {
            const double* const u = planes + 2 * c * plane + i;
            double* const out = rows + 3 * c * row + i;
            to(B, u, row, out, point);
            to(B, u + plane, row, out + 2 * row, point);
          }
        const auto dB = of_span<P, points>(y.basis, 1);
        for (int c = 0; c < fields; ++c)
          for (std::size_t i = 0; i < row; i += kLanes)
            to(dB, planes + 2 * c * plane + i, row, rows + (3 * c + 1) * row + i, point);
      });
}

template <int P>
void from_rows(const SpanBasis& y, const double* rows, std::size_t row, std::size_t plane, int fields,
               double* planes) {
  const std::size_t point = 3 * std::size_t(fields) * row;
  with_points<P>(
      y.points, [&](auto points) __attribute__((always_inline)) {
        const auto B = of_span<P, points>(y.basis, 0);
        for (int c = 0; c < fields; ++c)
          for (std::size_t i = 0; i < row; i += kLanes) {
            const double* const t = rows + 3 * c * row + i;
            double* const f = planes + 2 * c * plane + i;
            from(B, t, point, y.begun, f, row);
            from(B, t + 2 * row, point, y.begun, f + plane, row);
          }
        const auto dB = of_span<P, points>(y.basis, 1);
        for (int c = 0; c < fields; ++c)
          for (std::size_t i = 0; i < row; i += kLanes)
            from(dB, rows + (3 * c + 1) * row + i, point, P + 1, planes + 2 * c * plane + i, row);
      });
}

/// Lanes A, ..., A + kLanes - 1, counted from the first of `now`; those from kLanes on are in the word after.
template <int A, int... Lane>
[[gnu::always_inline]] inline Lanes lanes_from(const Lanes& now, const Lanes& after,
                                               std::integer_sequence<int, Lane...>) {
  return __builtin_shufflevector(now, after, (A + Lane)...);
}

/// The p + 1 control values of each span of a word: span s begins at control point s.  Aligned words are
/// loaded and shifted, since loads that straddle lines of the cache take twice as long.
template <int P>
struct Shifted {
  static constexpr int kWords = (P - 1) / kLanes + 2;
  std::size_t row;

  template <int A>
  [[gnu::always_inline]] static Lanes value(const Lanes (&word)[kWords]) {
    constexpr int kFirst = A / kLanes, kLane = A % kLanes;
    if constexpr (kLane == 0)
      return word[kFirst];
    else
      return lanes_from<kLane>(word[kFirst], word[kFirst + 1], std::make_integer_sequence<int, kLanes>());
  }
  template <int... A>
  [[gnu::always_inline]] static void take(const double* u, Lanes (&values)[P + 1],
                                          std::integer_sequence<int, A...>) {
    Lanes word[kWords];
    for (int k = 0; k < kWords; ++k) word[k] = load(u + k * kLanes);
    ((values[A] = value<A>(word)), ...);
  }
  [[gnu::always_inline]] void operator()(const double* u, Lanes (&values)[P + 1]) const {
    take(u, values, std::make_integer_sequence<int, P + 1>());
  }
};

/// The same where knots are repeated, and the values were written span by span.
template <int P>
struct Expanded {
  std::size_t row, control;  // from one to the next
  [[gnu::always_inline]] void operator()(const double* u, Lanes (&values)[P + 1]) const {
    for (int a = 0; a <= P; ++a) values[a] = load(u + a * control);
  }
};

template <int P, bool WithValue, class Values>
void words_to_points(const LaneBasis& x, const Values& values_at, const double* window, int fields,
                     double* values) {
  constexpr int kQuantities = WithValue ? 4 : 3;
  const std::size_t point = std::size_t(kQuantities) * fields * kLanes, row = values_at.row;
  for (int w = 0; w < x.words; ++w, window += kLanes) {
    const int word = x.first_word[w];
    const double* const basis = x.basis + std::size_t(word) * 2 * (P + 1) * kLanes;
    with_points<P>(
        x.first_word[w + 1] - word, [&](auto points) __attribute__((always_inline)) {
          const auto contract = [&](const PointBasis<P, points>& B, int c, int row_of, int quantity)
              __attribute__((always_inline)) {
            Lanes value[P + 1];
            values_at(window + (3 * c + row_of) * row, value);
            to(B, value, values + word * point + (kQuantities * c + quantity) * kLanes, point);
          };
          const auto B = of_word<P, points>(basis, 0);
          for (int c = 0; c < fields; ++c) {
            contract(B, c, 1, 1);
            contract(B, c, 2, 2);
            if (WithValue) contract(B, c, 0, 3);
          }
          const auto dB = of_word<P, points>(basis, 1);
          for (int c = 0; c < fields; ++c) contract(dB, c, 0, 0);
        });
  }
}

/// What the points of a word of spans give the p + 1 control points of each: of one field's d/dy, d/dz and
/// d/dx with the value, given to take(0: d/dx, 1, 2; [p + 1]) one after the other, while they are in
/// registers.
template <int P, int Points, bool WithValue, class Take>
[[gnu::always_inline]] inline void each_share(const double* B, const double* t, std::size_t stride,
                                              const Take& take) {
  constexpr int kPoint = 2 * (P + 1) * kLanes;
  const double* const dB = B + (P + 1) * kLanes;
  Lanes x[P + 1] = {}, y[P + 1] = {}, z[P + 1] = {};
  for (int q = 0; q < Points; ++q) {
    const Lanes t_y = load_once(t + q * stride + kLanes), t_z = load_once(t + q * stride + 2 * kLanes);
    for (int a = 0; a <= P; ++a) {
      const Lanes b = load_once(B + q * kPoint + a * kLanes);
      y[a] += b * t_y;
      z[a] += b * t_z;
    }
  }
  take(1, y);
  take(2, z);
  for (int q = 0; q < Points; ++q) {
    const Lanes t_x = load_once(t + q * stride);
    for (int a = 0; a <= P; ++a) {
      x[a] += load(dB + q * kPoint + a * kLanes) * t_x;
      if (WithValue) x[a] += load(B + q * kPoint + a * kLanes) * load(t + q * stride + 3 * kLanes);
    }
  }
  take(0, x);
}

template <int P, bool WithValue, class Take>
[[gnu::always_inline]] inline void each_share(const LaneBasis& x, int w, const double* values,
                                              std::size_t stride, const Take& take) {
  const int word = x.first_word[w];
  with_points<P>(
      x.first_word[w + 1] - word, [&](auto points) __attribute__((always_inline)) {
        each_share<P, points, WithValue>(x.basis + std::size_t(word) * 2 * (P + 1) * kLanes,
                                         values + stride * word, stride, take);
      });
}

/// Where knots are repeated, span s does not begin at control point s: the values of each span's functions
/// one row after the other, as many spans at a time as follow each other.
template <int P>
void expand(const LaneBasis& x, const double* rows, int count) {
  const std::size_t row = x.row;
  const auto out = [&](int k, int a) { return x.scratch + (k * (P + 1) + a) * row; };
  for (int s = 0, end; s < x.spans; s = end) {
    for (end = s + 1; end < x.spans && x.first_control[end] == x.first_control[end - 1] + 1;) ++end;
    for (int k = 0; k < count; ++k)
      for (int a = 0; a <= P; ++a)
        std::copy_n(rows + k * row + x.first_control[s] + a, end - s, out(k, a) + s);
  }
  const int rest = x.words * kLanes - x.spans;
  for (int k = 0; k < count && rest > 0; ++k)
    for (int a = 0; a <= P; ++a) std::fill_n(out(k, a) + x.spans, rest, 0.0);
}

template <int P, bool WithValue>
void to_points(const LaneBasis& x, const double* rows, int fields, double* values) {
  const std::size_t row = x.row;
  if (!x.first_control) return words_to_points<P, WithValue>(x, Shifted<P>{row}, rows, fields, values);
  expand<P>(x, rows, 3 * fields);
  words_to_points<P, WithValue>(x, Expanded<P>{(P + 1) * row, row}, x.scratch, fields, values);
}
template <int P>
void to_points(const LaneBasis& x, const double* rows, int fields, bool with_value, double* values) {
  (with_value ? to_points<P, true> : to_points<P, false>)(x, rows, fields, values);
}

/// Lanes -1, ..., kLanes - 2, counted from the first of `now`; lane -1 is the last of the word before.
template <int... Lane>
[[gnu::always_inline]] inline Lanes one_lane_back(const Lanes& before, const Lanes& now,
                                                  std::integer_sequence<int, Lane...>) {
  return __builtin_shufflevector(before, now, (kLanes - 1 + Lane)...);
}

/// What spans add to the control points where those of a word begin: of span s its first function, of span
/// s - 1 the second, ...  Summed like Horner's scheme, each step one lane on; `before` are the sums of
/// functions 1 to p of the word before, and then of this one.
template <int P>
[[gnu::always_inline]] inline Lanes sum_of_spans(const Lanes (&share)[P + 1], Lanes (&before)[P]) {
  Lanes sum = share[P];
  for (int a = P; a > 0; --a) {
    const Lanes back = one_lane_back(before[a - 1], sum, std::make_integer_sequence<int, kLanes>());
    before[a - 1] = sum;
    sum = share[a - 1] + back;
  }
  return sum;
}

template <int P, bool WithValue>
void from_points(const LaneBasis& x, const double* values, std::size_t stride, int fields, double* rows) {
  const std::size_t row = x.row;
  for (int c = 0; c < fields; ++c, values += (WithValue ? 4 : 3) * kLanes, rows += 3 * row) {
    Lanes before[3][P] = {};
    for (int w = 0; w < x.words; ++w) {
      each_share<P, WithValue>(x, w, values, stride, [&](int k, const Lanes(&share)[P + 1]) {
        store(sum_of_spans<P>(share, before[k]), rows + k * row + w * kLanes);
      });
    }
    constexpr Lanes kNone[P + 1] = {};
    for (std::size_t i = std::size_t(x.words) * kLanes; i < row; i += kLanes)
      for (int k = 0; k < 3; ++k) store(sum_of_spans<P>(kNone, before[k]), rows + k * row + i);
  }
}

/// The same where knots are repeated: span by span.
template <int P, bool WithValue>
void from_points_of_repeated_knots(const LaneBasis& x, const double* values, std::size_t stride, int fields,
                                   double* rows) {
  for (int i = 0; i < 3 * fields * x.row; ++i) rows[i] = 0.0;
  for (int c = 0; c < fields; ++c, values += (WithValue ? 4 : 3) * kLanes, rows += 3 * std::size_t(x.row))
    for (int w = 0; w < x.words; ++w)
      each_share<P, WithValue>(x, w, values, stride, [&](int k, const Lanes(&share)[P + 1]) {
        for (int lane = 0; lane < kLanes && w * kLanes + lane < x.spans; ++lane)
          for (int a = 0; a <= P; ++a)
            rows[k * x.row + x.first_control[w * kLanes + lane] + a] += share[a][lane];
      });
}
template <int P>
void from_points(const LaneBasis& x, const double* values, std::size_t stride, int fields, bool with_value,
                 double* rows) {
  const auto contract =
      x.first_control
          ? (with_value ? from_points_of_repeated_knots<P, true> : from_points_of_repeated_knots<P, false>)
          : (with_value ? from_points<P, true> : from_points<P, false>);
  contract(x, values, stride, fields, rows);
}

template <int P>
constexpr LineKernel kernel() {
  return {kLanes, to_planes<P>, from_planes<P>, to_rows<P>, from_rows<P>, to_points<P>, from_points<P>};
}

constexpr LineKernel kKernels[] = {kernel<2>(), kernel<3>(), kernel<4>(), kernel<5>()};

}  // namespace

namespace NURBS_SIMD_LEVEL {
const LineKernel& line_kernel(int degree) { return kKernels[degree - kLowestSweptDegree]; }
}  // namespace NURBS_SIMD_LEVEL

}  // namespace structure
