// SPDX-License-Identifier: GPL-2.0-or-later
// Contractions along one direction of a box: from control points to points, and their transposes.
// Sum factorisation: with R = Bx By Bz the sums over all control points of an element factor into sums over
// one direction at a time, (p+1) terms each instead of (p+1)^3 (Orszag 1980, J. Comput. Phys. 37, 70-92).
// Derivatives ride along: a plane holds (B, dB) u of one point in z, a row (B B, dB B, B dB) u of one in y,
// points of a row hold all derivatives.  Knot spans along x lie side by side in words of numbers.
//
// Layouts, the last index fastest; a row is padded to whole words:
//   nodes   [field][z][y][row]
//   planes  [point in z][field][value, d/dz][y][row], of one knot span in z
//   rows    [point in y][field][value, d/dy, d/dz][row], of one knot span in y
//   values  [point word][field][d/dx, d/dy, d/dz (, value)][lane], of one row
#pragma once

#include <cstddef>

#include "nurbs/simd_level.h"

namespace structure {

constexpr int kLowestSweptDegree = 2, kHighestSweptDegree = 5;

/// Functions at the points of one knot span, [point][B, dB][p + 1].
struct SpanBasis {
  int points;
  const double* basis;
  int begun;  ///< how many of its first control points the spans before have, too
};

/// Functions at the points of all knot spans along x.
struct LaneBasis {
  int spans, words;          ///< words of spans
  int row;                   ///< numbers in a padded row: whole words
  const int* first_word;     ///< [word + 1] point words before; points of a word at most p + 1
  const double* basis;       ///< [point word][B, dB][p + 1][lane]; 0 where a span has no such point
  const int* first_control;  ///< [span] control point; null where that of span s is s
  double* scratch;           ///< where it is not: values span by span, [field][3][p + 1][row]
};

/// Contractions of a direction of one degree.
struct LineKernel {
  int lanes;  ///< numbers in a word
  /// planes = sum over p + 1 planes of nodes, from the first of the span on.
  void (*to_planes)(const SpanBasis& z, const double* nodes, std::size_t plane, std::size_t field, int fields,
                    double* planes);
  /// Transposed: added where spans before have begun a sum, else the first of it.
  void (*from_planes)(const SpanBasis& z, const double* planes, std::size_t plane, std::size_t field,
                      int fields, double* nodes);
  /// rows = sum over p + 1 rows of planes, from the first of the span on.
  void (*to_rows)(const SpanBasis& y, const double* planes, std::size_t row, std::size_t plane, int fields,
                  double* rows);
  void (*from_rows)(const SpanBasis& y, const double* rows, std::size_t row, std::size_t plane, int fields,
                    double* planes);
  /// values of one point in y; `with_value` of the function itself, too.
  void (*to_points)(const LaneBasis& x, const double* rows, int fields, bool with_value, double* values);
  /// Transposed; `stride` numbers of one point word to the next.
  void (*from_points)(const LaneBasis& x, const double* values, std::size_t stride, int fields,
                      bool with_value, double* rows);
};

/// For degrees kLowestSweptDegree to kHighestSweptDegree.
const LineKernel& line_kernel(int degree, nurbs::SimdLevel level);

}  // namespace structure
