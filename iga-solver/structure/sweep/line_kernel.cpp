// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, and no header with inline functions is included: code for a newer processor must never be
// what the linker picks for all.
#include "structure/sweep/line_kernel.h"

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

/// Control values of one word of spans, of all fields: (p + 1) of value, d/dy, d/dz.
struct Window {
  const double* values;
  std::size_t control, row;  // from one to the next
};

template <int P, int Points, bool WithValue>
void word_to_points(const double* basis, const Window& window, int fields, double* values) {
  constexpr int kQuantities = WithValue ? 4 : 3;
  const double* u = window.values;
  for (int c = 0; c < fields; ++c, u += 3 * window.row) {
    Lanes value[P + 1], d_y[P + 1], d_z[P + 1];
    for (int a = 0; a <= P; ++a) {
      value[a] = load(u + a * window.control);
      d_y[a] = load(u + window.row + a * window.control);
      d_z[a] = load(u + 2 * window.row + a * window.control);
    }
    for (int q = 0; q < Points; ++q) {
      const double *B = basis + 2 * (P + 1) * kLanes * q, *dB = B + (P + 1) * kLanes;
      Lanes sum[4] = {};
      for (int a = 0; a <= P; ++a) {
        const Lanes b = load(B + kLanes * a);
        sum[0] += load(dB + kLanes * a) * value[a];
        sum[1] += b * d_y[a];
        sum[2] += b * d_z[a];
        if (WithValue) sum[3] += b * value[a];
      }
      for (int k = 0; k < kQuantities; ++k)
        store(sum[k], values + (kQuantities * (c + fields * q) + k) * kLanes);
    }
  }
}

template <int P, int Points, bool WithValue>
void word_from_points(const double* basis, const double* values, std::size_t stride, int fields,
                      std::size_t control, double* out) {
  constexpr int kQuantities = WithValue ? 4 : 3;
  for (int c = 0; c < fields; ++c, out += 3 * (P + 1) * control) {
    Lanes value[P + 1] = {}, d_y[P + 1] = {}, d_z[P + 1] = {};
    for (int q = 0; q < Points; ++q) {
      const double *B = basis + 2 * (P + 1) * kLanes * q, *dB = B + (P + 1) * kLanes;
      const double* t = values + stride * q + kQuantities * kLanes * c;
      for (int a = 0; a <= P; ++a) {
        const Lanes b = load(B + kLanes * a);
        value[a] += load(dB + kLanes * a) * load(t);
        if (WithValue) value[a] += b * load(t + 3 * kLanes);
        d_y[a] += b * load(t + kLanes);
        d_z[a] += b * load(t + 2 * kLanes);
      }
    }
    for (int a = 0; a <= P; ++a) {
      store(value[a], out + a * control);
      store(d_y[a], out + (P + 1 + a) * control);
      store(d_z[a], out + (2 * (P + 1) + a) * control);
    }
  }
}

/// Where knots are repeated, span s does not begin at control point s: the values of each span's functions
/// one row after the other.
template <int P>
void expand(const LaneBasis& x, const double* rows, int count) {
  for (int k = 0; k < count; ++k)
    for (int a = 0; a <= P; ++a) {
      double* out = x.scratch + (k * (P + 1) + a) * std::size_t(x.margin + x.row) + x.margin;
      for (int s = 0; s < x.spans; ++s) out[s] = rows[k * std::size_t(x.row) + x.first_control[s] + a];
    }
}

template <int P, bool WithValue>
void to_points(const LaneBasis& x, const double* rows, int fields, double* values) {
  const std::size_t length = x.margin + x.row;
  Window window{rows, 1, std::size_t(x.row)};
  if (x.first_control) {
    expand<P>(x, rows, 3 * fields);
    window = {x.scratch + x.margin, length, (P + 1) * length};
  }
  for (int w = 0; w < x.words; ++w, window.values += kLanes) {
    const int word = x.first_word[w], points = x.first_word[w + 1] - word;
    const double* basis = x.basis + std::size_t(word) * 2 * (P + 1) * kLanes;
    double* out = values + std::size_t(word) * (WithValue ? 4 : 3) * fields * kLanes;
    const auto contract = points == P + 1 ? word_to_points<P, P + 1, WithValue>
                          : points == P   ? word_to_points<P, P, WithValue>
                                          : word_to_points<P, P - 1, WithValue>;
    contract(basis, window, fields, out);
  }
}
template <int P>
void to_points(const LaneBasis& x, const double* rows, int fields, bool with_value, double* values) {
  (with_value ? to_points<P, true> : to_points<P, false>)(x, rows, fields, values);
}

/// A control point's sum: from the spans that begin at it, at the one before, ...
template <int P>
void add_spans(const LaneBasis& x, const double* shares, double* row) {
  const std::size_t length = x.margin + x.row;
  shares += x.margin;
  if (!x.first_control) {
    for (int i = 0; i < x.row; i += kLanes) {
      Lanes sum = load(shares + i);
      for (int a = 1; a <= P; ++a) sum += load(shares + a * length + i - a);
      store(sum, row + i);
    }
    return;
  }
  for (int i = 0; i < x.row; ++i) row[i] = 0.0;
  for (int a = 0; a <= P; ++a)
    for (int s = 0; s < x.spans; ++s) row[x.first_control[s] + a] += shares[a * length + s];
}

template <int P, bool WithValue>
void from_points(const LaneBasis& x, const double* values, std::size_t stride, int fields, double* rows) {
  const std::size_t length = x.margin + x.row;
  for (int w = 0; w < x.words; ++w) {
    const int word = x.first_word[w], points = x.first_word[w + 1] - word;
    const double* basis = x.basis + std::size_t(word) * 2 * (P + 1) * kLanes;
    const auto contract = points == P + 1 ? word_from_points<P, P + 1, WithValue>
                          : points == P   ? word_from_points<P, P, WithValue>
                                          : word_from_points<P, P - 1, WithValue>;
    contract(basis, values + stride * word, stride, fields, length, x.scratch + x.margin + w * kLanes);
  }
  for (int k = 0; k < 3 * fields; ++k)
    add_spans<P>(x, x.scratch + k * (P + 1) * length, rows + k * std::size_t(x.row));
}
template <int P>
void from_points(const LaneBasis& x, const double* values, std::size_t stride, int fields, bool with_value,
                 double* rows) {
  (with_value ? from_points<P, true> : from_points<P, false>)(x, values, stride, fields, rows);
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
