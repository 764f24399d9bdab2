// SPDX-License-Identifier: GPL-2.0-or-later
// Words of several numbers, as long as the processor that a file is compiled for has them: points (x, y, z,
// W) and, for kLanes points at a time, one number of each (nurbs/lanes.h).
#pragma once

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include "nurbs/lanes.h"

namespace search {
namespace {

using nurbs::lanes::kLanes;
using nurbs::lanes::Lanes;  // one number of kLanes points

template <int N>
struct Word {
  typedef double Numbers __attribute__((vector_size(8 * N)));
};
typedef decltype(Lanes{} < Lanes{}) LaneMask;
typedef int LaneIndices __attribute__((vector_size(4 * kLanes)));
/// Coordinates of kLanes points.
struct LaneVector {
  Lanes x, y, z;
};
/// (x, y, z, W) of one point, in words that the processor has.
#if defined(__AVX2__)
typedef Word<4>::Numbers Vector4;
[[gnu::always_inline]] inline Vector4 load3(const double* numbers) {
  return Vector4{numbers[0], numbers[1], numbers[2], 0.0};
}
[[gnu::always_inline]] inline Vector4 with_fourth(const Vector4& v, double w) {
  return Vector4{v[0], v[1], v[2], w};
}
#else
struct Vector4 {
  Word<2>::Numbers xy, zw;
  double operator[](int i) const { return i < 2 ? xy[i] : zw[i - 2]; }
};
[[gnu::always_inline]] inline Vector4 operator+(const Vector4& a, const Vector4& b) {
  return {a.xy + b.xy, a.zw + b.zw};
}
[[gnu::always_inline]] inline Vector4 operator-(const Vector4& a, const Vector4& b) {
  return {a.xy - b.xy, a.zw - b.zw};
}
[[gnu::always_inline]] inline Vector4 operator*(const Vector4& a, const Vector4& b) {
  return {a.xy * b.xy, a.zw * b.zw};
}
[[gnu::always_inline]] inline Vector4 operator*(double f, const Vector4& a) { return {f * a.xy, f * a.zw}; }
[[gnu::always_inline]] inline Vector4 load3(const double* numbers) {
  return {Word<2>::Numbers{numbers[0], numbers[1]}, Word<2>::Numbers{numbers[2], 0.0}};
}
[[gnu::always_inline]] inline Vector4 with_fourth(const Vector4& v, double w) {
  return {v.xy, Word<2>::Numbers{v.zw[0], w}};
}
#endif

[[gnu::always_inline]] inline Vector4 load(const double* numbers) {  // of any alignment
  Vector4 v;
  __builtin_memcpy(&v, numbers, sizeof v);
  return v;
}
template <class Numbers, class Number>
[[gnu::always_inline]] inline void store(const Numbers& v, Number* numbers) {
  __builtin_memcpy(numbers, &v, sizeof v);
}
[[gnu::always_inline]] inline Lanes load_lanes(const double* numbers) { return nurbs::lanes::load(numbers); }

[[gnu::always_inline]] inline LaneVector operator+(const LaneVector& a, const LaneVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline LaneVector operator-(const LaneVector& a, const LaneVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline LaneVector operator*(const Lanes& f, const LaneVector& a) {
  return {f * a.x, f * a.y, f * a.z};
}
[[gnu::always_inline]] inline LaneVector operator*(const LaneVector& a, const LaneVector& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
[[gnu::always_inline]] inline Lanes dot(const LaneVector& a, const LaneVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// a b + c, rounded once where the processor can.  Nothing else is: the compiler is told to contract no
/// products of its own choice (-ffp-contract=off), so that one point and several in a word give the same
/// bits.
#if defined(__FMA__)
typedef Word<4>::Numbers Four;
[[gnu::always_inline]] inline double multiply_add(double a, double b, double c) {
  return __builtin_fma(a, b, c);
}
[[gnu::always_inline]] inline Four multiply_add(const Four& a, const Four& b, const Four& c) {
  return _mm256_fmadd_pd(a, b, c);
}
[[gnu::always_inline]] inline Four multiply_add(double a, const Four& b, const Four& c) {
  return _mm256_fmadd_pd(_mm256_set1_pd(a), b, c);
}
#if defined(__AVX512F__)
[[gnu::always_inline]] inline Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c) {
  return _mm512_fmadd_pd(a, b, c);
}
[[gnu::always_inline]] inline Lanes multiply_add(double a, const Lanes& b, const Lanes& c) {
  return _mm512_fmadd_pd(_mm512_set1_pd(a), b, c);
}
#endif
#else
template <class Factor, class Number>
[[gnu::always_inline]] inline Number multiply_add(const Factor& a, const Number& b, const Number& c) {
  return a * b + c;
}
#endif
[[gnu::always_inline]] inline LaneVector multiply_add(const Lanes& a, const LaneVector& b,
                                                      const LaneVector& c) {
  return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)};
}
[[gnu::always_inline]] inline LaneVector multiply_add(const LaneVector& a, const LaneVector& b,
                                                      const LaneVector& c) {
  return {multiply_add(a.x, b.x, c.x), multiply_add(a.y, b.y, c.y), multiply_add(a.z, b.z, c.z)};
}

[[gnu::always_inline]] inline double dot(const Vector4& a, const Vector4& b) {
  const Vector4 ab = a * b;
  return ab[0] + ab[1] + ab[2];
}

template <class Numbers>
[[gnu::always_inline]] inline Numbers absolute(const Numbers& x) {
  return x < 0.0 ? -x : x;
}
[[gnu::always_inline]] inline double absolute(double x) { return __builtin_fabs(x); }
#if !defined(__AVX2__)
[[gnu::always_inline]] inline Vector4 absolute(const Vector4& a) { return {absolute(a.xy), absolute(a.zw)}; }
#endif
int count(bool mask) { return mask; }
LaneMask count(const LaneMask& mask) { return -mask; }
bool any(bool mask) { return mask; }
bool any(const LaneMask& mask) {
  typedef signed char Bytes __attribute__((vector_size(kLanes)));
  const Bytes bytes = __builtin_convertvector(mask, Bytes);
  long long bits = 0;
  __builtin_memcpy(&bits, &bytes, sizeof bytes);
  return bits != 0;
}
template <class Number>
[[gnu::always_inline]] inline Number larger(const Number& a, const Number& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Lanes root(const Lanes& x) {
  Lanes y;
  for (int lane = 0; lane < kLanes; ++lane) y[lane] = __builtin_sqrt(x[lane]);
  return y;
}
template <class Number>
[[gnu::always_inline]] inline Number square(const Number& x) {
  return x * x;
}

/// out[c][lane] = rows[lane][c]
template <int N>
void transpose(const Vector4 (&rows)[N], typename Word<N>::Numbers (&out)[4]) {
  using Numbers = typename Word<N>::Numbers;
  if constexpr (N == 8) {
    Numbers xz[2], yw[2];  // of four lanes: x x z z x x z z, y y w w y y w w
    for (int i = 0; i < 2; ++i) {
      const auto pair = [&](int k) {
        return __builtin_shufflevector(rows[k], rows[k + 2], 0, 1, 2, 3, 4, 5, 6, 7);
      };
      const Numbers even = pair(4 * i), odd = pair(4 * i + 1);
      xz[i] = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14);
      yw[i] = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
    }
    out[0] = __builtin_shufflevector(xz[0], xz[1], 0, 1, 4, 5, 8, 9, 12, 13);
    out[1] = __builtin_shufflevector(yw[0], yw[1], 0, 1, 4, 5, 8, 9, 12, 13);
    out[2] = __builtin_shufflevector(xz[0], xz[1], 2, 3, 6, 7, 10, 11, 14, 15);
    out[3] = __builtin_shufflevector(yw[0], yw[1], 2, 3, 6, 7, 10, 11, 14, 15);
  } else if constexpr (N == 4) {
    Numbers xz[2], yw[2];  // of two lanes: x x z z, y y w w
    for (int i = 0; i < 2; ++i) {
      xz[i] = __builtin_shufflevector(rows[2 * i], rows[2 * i + 1], 0, 4, 2, 6);
      yw[i] = __builtin_shufflevector(rows[2 * i], rows[2 * i + 1], 1, 5, 3, 7);
    }
    out[0] = __builtin_shufflevector(xz[0], xz[1], 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(yw[0], yw[1], 0, 1, 4, 5);
    out[2] = __builtin_shufflevector(xz[0], xz[1], 2, 3, 6, 7);
    out[3] = __builtin_shufflevector(yw[0], yw[1], 2, 3, 6, 7);
  } else {
    for (int c = 0; c < 4; ++c) out[c] = Numbers{rows[0][c], rows[1][c]};
  }
}

/// The sum over x, y, z of each.
[[gnu::always_inline]] inline void sums(const LaneVector (&a)[4], Lanes (&out)[4]) {
  for (int k = 0; k < 4; ++k) out[k] = a[k].x + a[k].y + a[k].z;
}
[[gnu::always_inline]] inline void sums(const Vector4 (&a)[4], double (&out)[4]) {
#if defined(__AVX2__)
  Vector4 c[4];
  transpose(a, c);
  store(c[0] + c[1] + c[2], out);
#else
  for (int k = 0; k < 4; ++k) out[k] = a[k][0] + a[k][1] + a[k][2];
#endif
}

}  // namespace
}  // namespace search
