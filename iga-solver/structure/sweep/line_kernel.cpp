// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all.
#include "structure/sweep/line_kernel.h"

#include <utility>

#include "structure/sweep/lanes.h"

namespace structure {
namespace {

template <int P>
void to_plane(const double* basis, const double* nodes, std::size_t plane, std::size_t field, int fields,
              double* planes) {
  const double *B = basis, *dB = basis + P + 1;
  for (int c = 0; c < fields; ++c, nodes += field, planes += 2 * plane)
    for (std::size_t i = 0; i < plane; i += kLanes) {
      Lanes value{}, slope{};
      for (int a = 0; a <= P; ++a) {
        const Lanes u = load(nodes + a * plane + i);
        value += B[a] * u;
        slope += dB[a] * u;
      }
      store(value, planes + i);
      store(slope, planes + plane + i);
    }
}

template <int P>
void from_plane(const double* basis, const double* planes, std::size_t plane, std::size_t field, int fields,
                double* nodes) {
  const double *B = basis, *dB = basis + P + 1;
  for (int c = 0; c < fields; ++c, nodes += field, planes += 2 * plane)
    for (std::size_t i = 0; i < plane; i += kLanes) {
      const Lanes value = load(planes + i), slope = load(planes + plane + i);
      for (int a = 0; a <= P; ++a) {
        double* f = nodes + a * plane + i;
        store(load(f) + B[a] * value + dB[a] * slope, f);
      }
    }
}

template <int P, int Points>
void to_rows(const double* basis, const double* planes, std::size_t row, std::size_t plane, int fields,
             double* rows) {
  for (int c = 0; c < fields; ++c, planes += 2 * plane)
    for (std::size_t i = 0; i < row; i += kLanes) {
      Lanes u[P + 1], u_z[P + 1];
      for (int a = 0; a <= P; ++a) {
        u[a] = load(planes + a * row + i);
        u_z[a] = load(planes + plane + a * row + i);
      }
      for (int q = 0; q < Points; ++q) {
        const double *B = basis + 2 * (P + 1) * q, *dB = B + P + 1;
        Lanes value{}, d_y{}, d_z{};
        for (int a = 0; a <= P; ++a) {
          value += B[a] * u[a];
          d_y += dB[a] * u[a];
          d_z += B[a] * u_z[a];
        }
        double* out = rows + 3 * (c + std::size_t(fields) * q) * row + i;
        store(value, out);
        store(d_y, out + row);
        store(d_z, out + 2 * row);
      }
    }
}

template <int P, int Points>
void from_rows(const double* basis, const double* rows, std::size_t row, std::size_t plane, int fields,
               double* planes) {
  for (int c = 0; c < fields; ++c, planes += 2 * plane)
    for (int a = 0; a <= P; ++a)
      for (std::size_t i = 0; i < row; i += kLanes) {
        double* const f = planes + a * row + i;
        Lanes value = load(f), d_z = load(f + plane);
        for (int q = 0; q < Points; ++q) {
          const double *B = basis + 2 * (P + 1) * q, *dB = B + P + 1;
          const double* t = rows + 3 * (c + std::size_t(fields) * q) * row + i;
          value += B[a] * load(t) + dB[a] * load(t + row);
          d_z += B[a] * load(t + 2 * row);
        }
        store(value, f);
        store(d_z, f + plane);
      }
}

// Spans have p - 1, p or p + 1 points (quadrature.h).
template <int P>
void to_rows(const SpanBasis& y, const double* planes, std::size_t row, std::size_t plane, int fields,
             double* rows) {
  const auto contract = y.points == P + 1 ? to_rows<P, P + 1>
                        : y.points == P   ? to_rows<P, P>
                                          : to_rows<P, P - 1>;
  contract(y.basis, planes, row, plane, fields, rows);
}
template <int P>
void from_rows(const SpanBasis& y, const double* rows, std::size_t row, std::size_t plane, int fields,
               double* planes) {
  const auto contract = y.points == P + 1 ? from_rows<P, P + 1>
                        : y.points == P   ? from_rows<P, P>
                                          : from_rows<P, P - 1>;
  contract(y.basis, rows, row, plane, fields, planes);
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

/// Functions at the points of a word of spans: B or dB.
template <int P, int Points>
struct WordBasis {
  Lanes of[Points][P + 1];
  WordBasis(const double* basis, int derivative) {
    for (int q = 0; q < Points; ++q)
      for (int a = 0; a <= P; ++a) of[q][a] = load(basis + ((2 * q + derivative) * (P + 1) + a) * kLanes);
  }
};

/// Sums over control values, to points `point` apart.
template <int P, int Points, class Values>
[[gnu::always_inline]] inline void contract(const WordBasis<P, Points>& basis, const Values& values_at,
                                            const double* u, double* out, std::size_t point) {
  Lanes value[P + 1];
  values_at(u, value);
  for (int q = 0; q < Points; ++q) {
    Lanes sum = basis.of[q][0] * value[0];
    for (int a = 1; a <= P; ++a) sum += basis.of[q][a] * value[a];
    store(sum, out + q * point);
  }
}

// B for all that it is needed for, then dB: one of them has room in the registers.
template <int P, int Points, bool WithValue, class Values>
void word_to_points(const double* basis, const Values& values_at, const double* window, int fields,
                    double* values) {
  constexpr int kQuantities = WithValue ? 4 : 3;
  const std::size_t point = std::size_t(kQuantities) * fields * kLanes, row = values_at.row;
  const WordBasis<P, Points> B(basis, 0);
  for (int c = 0; c < fields; ++c) {
    const double* const u = window + 3 * c * row;
    double* const out = values + kQuantities * c * kLanes;
    contract(B, values_at, u + row, out + kLanes, point);
    contract(B, values_at, u + 2 * row, out + 2 * kLanes, point);
    if (WithValue) contract(B, values_at, u, out + 3 * kLanes, point);
  }
  const WordBasis<P, Points> dB(basis, 1);
  for (int c = 0; c < fields; ++c)
    contract(dB, values_at, window + 3 * c * row, values + kQuantities * c * kLanes, point);
}

template <int P, bool WithValue, class Values>
void words_to_points(const LaneBasis& x, const Values& values_at, const double* window, int fields,
                     double* values) {
  for (int w = 0; w < x.words; ++w, window += kLanes) {
    const int word = x.first_word[w], points = x.first_word[w + 1] - word;
    const double* basis = x.basis + std::size_t(word) * 2 * (P + 1) * kLanes;
    double* out = values + std::size_t(word) * (WithValue ? 4 : 3) * fields * kLanes;
    const auto contract = points == P + 1 ? word_to_points<P, P + 1, WithValue, Values>
                          : points == P   ? word_to_points<P, P, WithValue, Values>
                                          : word_to_points<P, P - 1, WithValue, Values>;
    contract(basis, values_at, window, fields, out);
  }
}

/// Shares of the p + 1 control points of each span of a word, for value, d/dy, d/dz.
template <int P>
struct Shares {
  Lanes of[3][P + 1];
};

template <int P, int Points, bool WithValue>
[[gnu::always_inline]] inline void add_points(const double* __restrict basis, const double* __restrict t,
                                              std::size_t stride, Shares<P>& shares) {
  for (int q = 0; q < Points; ++q, t += stride) {
    const double *B = basis + 2 * (P + 1) * kLanes * q, *dB = B + (P + 1) * kLanes;
    const Lanes t_x = load(t), t_y = load(t + kLanes), t_z = load(t + 2 * kLanes);
    for (int a = 0; a <= P; ++a) {
      const Lanes b = load(B + kLanes * a);
      shares.of[0][a] += load(dB + kLanes * a) * t_x;
      if (WithValue) shares.of[0][a] += b * load(t + 3 * kLanes);
      shares.of[1][a] += b * t_y;
      shares.of[2][a] += b * t_z;
    }
  }
}

template <int P, bool WithValue>
[[gnu::always_inline]] inline Shares<P> word_shares(const LaneBasis& x, int w, const double* values,
                                                    std::size_t stride) {
  Shares<P> shares = {};
  const int word = x.first_word[w], points = x.first_word[w + 1] - word;
  const double* const basis = x.basis + std::size_t(word) * 2 * (P + 1) * kLanes;
  const double* const t = values + stride * word;
  if (points == P + 1) add_points<P, P + 1, WithValue>(basis, t, stride, shares);
  if (points == P) add_points<P, P, WithValue>(basis, t, stride, shares);
  if (points == P - 1) add_points<P, P - 1, WithValue>(basis, t, stride, shares);
  return shares;
}

/// Where knots are repeated, span s does not begin at control point s: the values of each span's functions
/// one row after the other.
template <int P>
void expand(const LaneBasis& x, const double* rows, int count) {
  for (int k = 0; k < count; ++k)
    for (int a = 0; a <= P; ++a) {
      double* out = x.scratch + (k * (P + 1) + a) * std::size_t(x.row);
      for (int s = 0; s < x.spans; ++s) out[s] = rows[k * std::size_t(x.row) + x.first_control[s] + a];
      for (int s = x.spans; s < x.words * kLanes; ++s) out[s] = 0.0;
    }
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

/// Lanes -A, ..., kLanes - 1 - A, counted from the first of `now`; those below 0 are in the word before.
template <int A, int... Lane>
[[gnu::always_inline]] inline Lanes lanes_before(const Lanes& before, const Lanes& now,
                                                 std::integer_sequence<int, Lane...>) {
  return __builtin_shufflevector(before, now, (kLanes - A + Lane)...);
}

/// What spans of this word and of words before add to control points w kLanes, ...: of the span that begins
/// at one its first function, of the span before the second, ...  history[h] is the word h before this one.
template <int P, int A = 0>
[[gnu::always_inline]] inline Lanes sum_of_spans(const Lanes (&history)[(P - 1) / kLanes + 2][P + 1]) {
  constexpr int kWord = A / kLanes, kLane = A % kLanes;
  Lanes share = history[kWord][A];
  if constexpr (kLane > 0)
    share = lanes_before<kLane>(history[kWord + 1][A], share, std::make_integer_sequence<int, kLanes>());
  if constexpr (A < P)
    return share + sum_of_spans<P, A + 1>(history);
  else
    return share;
}

template <int P, bool WithValue>
void from_points(const LaneBasis& x, const double* values, std::size_t stride, int fields, double* rows) {
  constexpr int kWordsBack = (P - 1) / kLanes + 1;
  for (int c = 0; c < fields; ++c, values += (WithValue ? 4 : 3) * kLanes, rows += 3 * std::size_t(x.row)) {
    Lanes history[3][kWordsBack + 1][P + 1] = {};
    for (int w = 0; w * kLanes < x.row; ++w) {
      const Shares<P> shares = w < x.words ? word_shares<P, WithValue>(x, w, values, stride) : Shares<P>{};
      for (int k = 0; k < 3; ++k) {
        for (int h = kWordsBack; h > 0; --h)
          for (int a = 0; a <= P; ++a) history[k][h][a] = history[k][h - 1][a];
        for (int a = 0; a <= P; ++a) history[k][0][a] = shares.of[k][a];
        store(sum_of_spans<P>(history[k]), rows + k * std::size_t(x.row) + w * kLanes);
      }
    }
  }
}

/// The same where knots are repeated: span by span.
template <int P, bool WithValue>
void from_points_of_repeated_knots(const LaneBasis& x, const double* values, std::size_t stride, int fields,
                                   double* rows) {
  for (int i = 0; i < 3 * fields * x.row; ++i) rows[i] = 0.0;
  for (int c = 0; c < fields; ++c, values += (WithValue ? 4 : 3) * kLanes, rows += 3 * std::size_t(x.row))
    for (int w = 0; w < x.words; ++w) {
      const Shares<P> shares = word_shares<P, WithValue>(x, w, values, stride);
      for (int lane = 0; lane < kLanes && w * kLanes + lane < x.spans; ++lane)
        for (int k = 0; k < 3; ++k)
          for (int a = 0; a <= P; ++a)
            rows[k * x.row + x.first_control[w * kLanes + lane] + a] += shares.of[k][a][lane];
    }
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
  return {kLanes, to_plane<P>, from_plane<P>, to_rows<P>, from_rows<P>, to_points<P>, from_points<P>};
}

constexpr LineKernel kKernels[] = {kernel<2>(), kernel<3>(), kernel<4>(), kernel<5>()};

}  // namespace

namespace NURBS_SIMD_LEVEL {
const LineKernel& line_kernel(int degree) { return kKernels[degree - kLowestSweptDegree]; }
}  // namespace NURBS_SIMD_LEVEL

}  // namespace structure
