// SPDX-License-Identifier: GPL-2.0-or-later
// What happens at the points of a row: derivatives in parameters become strains, a law gives stresses, and
// these become what the functions' derivatives are tested with.
//   H = du/dxi J^-1,   T = w|J| P(H) J^-T,   f_A = sum over points of T dB_A
// Rational functions R_A = w_A B_A / W go the same way: of N = sum w_A B_A u_A is u = N / W and
// du/dxi = (dN - u dW) / W, so with K = J^-1 / W and g = dW / W
//   H = (dN - N g) K,   T = w|J| P K^T on dB_A, -T g on B_A,   both times w_A at the end.
#pragma once

#include <cstddef>

#include "nurbs/simd_level.h"

namespace structure {

/// Where the kernels find the map's Jacobian J = dX/dxi.
enum class GeometryMode {
  affine,     ///< the same at all points
  stored,     ///< K, w|J| (and g) of every point in a table
  recomputed  ///< from the control points, whose values ride along: fields X w_A and, if rational, w_A
};

/// Numbers of a point in the table.
constexpr int table_numbers(bool rational) { return rational ? 13 : 10; }

/// Laws that kernels do not hold inlined, and those with memory: one point after the other.
struct OutsideLaw {
  const void* law;
  /// P of H, both [9]; `state` is evolved to `next` first unless that is null.
  void (*stress)(const void* law, const double* H, const double* state, double* next, double dt, double* P);
  double (*energy_density)(const void* law, const double* H, const double* state);
  /// dP of a change G of H.
  void (*stress_change)(const void* law, const double* H, const double* G, const double* state, double* dP);
  const double* state;  ///< of the row
  double* next;
  double dt;
  const std::ptrdiff_t* offset;  ///< [point word][lane]: where a point's numbers are in the row's
};

/// One row of points.
struct PointRow {
  double* values;         ///< [point word][field][quantity][lane], line_kernel.h
  int words;              ///< point words
  const double* weights;  ///< [point word][lane] along the row; 0 where there is no point
  double weight;          ///< of the two other directions
  double* table;          ///< stored: [point word][table_numbers][lane]
  const double* affine;   ///< affine: J^-1 row after row, |J|
  const void* law;        ///< inlined: the law; else the OutsideLaw
};

/// What a loop over points leaves beside the values.
struct PointSums {
  double sum;        ///< energy, or volume
  double least_det;  ///< smallest |J|
};

using PointLoop = void (*)(const PointRow& row, PointSums& sums);

/// Loops of one way to find the geometry; those over a law by its place in ElasticLaws, last the outside one.
struct PointLoops {
  PointLoop stress[8];  ///< values become T
  PointLoop energy[8];  ///< adds to the sum
  PointLoop
      stress_change[8];  ///< behind the displacements' fields stand those of a change: values become T of it
};
const PointLoops& point_loops(GeometryMode mode, bool rational, nurbs::SimdLevel level);

/// Of an affine map that only stretches: direction d of the row's three goes along axis (d + shift) % 3.
const PointLoops& aligned_loops(int shift, nurbs::SimdLevel level);

/// Loops over geometry alone; values are those of recomputed geometry without displacements.
struct GeometryLoops {
  PointLoop tabulate;  ///< fills the table
  PointLoop mass;      ///< values of the first field become w|J| (/ W) on the function itself; sums volume
};
const GeometryLoops& geometry_loops(bool rational, nurbs::SimdLevel level);

}  // namespace structure
