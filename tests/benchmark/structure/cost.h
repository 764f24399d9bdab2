// SPDX-License-Identifier: GPL-2.0-or-later
// What one evaluation must read and work out, counted from the formulas: the least that memory and
// arithmetic allow, whatever caches do.
#pragma once

#include <array>

#include "stiffness.h"
#include "structure/solid/solid.h"

namespace benchmarks {

struct Cost {
  double bytes = 0.0;  ///< to and from memory, once through the data
  double flops = 0.0;  ///< additions and multiplications
};

/// Of P(H) at one point.
struct MaterialFlops {
  /// trace 2, lambda tr 1; diagonal 3 (2 mu e + lambda tr); the others 3 (a + b) mu.
  static constexpr double kLinear = 2 + 1 + 6 + 6;
  /// E = (H + H^T + H^T H) / 2: 6 (5 + 3); S: 2 + 1 + 6 + 3; P = S + H S: 9 x 6.
  static constexpr double kSaintVenantKirchhoff = 48 + 12 + 54;
  /// cof F - I: 3 + 6 x 3 + 3 x 4; J, J - 1: 3 + 5 + 3; ln J and 1 / J: 24; g: 5; P: 9 x 3 + 3.
  static constexpr double kNeoHooke = 33 + 11 + 24 + 5 + 30;
};

/// Displacements read, forces read and written.
inline double vector_bytes(const nurbs::Space<3>& space) {
  return 3.0 * 8.0 * 3.0 * space.control_point_count();
}

/// The plain element loop: dR/dX [point][3][padded functions], w|J| and nodes are read, and at each point
/// H = sum u_A (x) dR_A/dX and f_A += P dR_A/dX take 9 multiplications and 9 additions per function each, and
/// w|J| P nine.
inline Cost plain_cost(const nurbs::Space<3>& space, int points, double material_flops) {
  const int n = space.functions_per_element(), padded = (n + 3) / 4 * 4;
  const double elements = space.element_count();
  return {elements * (points * (24.0 * padded + 8.0) + 4.0 * n) + vector_bytes(space),
          elements * points * (36.0 * padded + 9.0 + material_flops)};
}

/// Sweeps over tensor products.  `points` of each direction; fields are the three of u and, where geometry is
/// recomputed, of X (and of W).  Going in, a field becomes its value and derivative in z at each plane of
/// points, then value and two derivatives at each row, then three derivatives (and the value, if rational) at
/// each point: p + 1 multiplications and additions for each of them.  Three fields of forces come back alike.
inline Cost sweep_cost(const nurbs::Space<3>& space, const std::array<double, 3>& points,
                       structure::IntegrationMethod method, double material_flops) {
  const bool rational = space.rational(), recomputed = method == structure::IntegrationMethod::recomputed;
  const double fields = 6.0 + (recomputed ? (rational ? 4.0 : 3.0) : 0.0);
  const double nx = space.control_point_count(0), ny = space.control_point_count(1);
  const double rows = points[1] * points[2], all = points[0] * rows, p = space.degree(0);
  const double contractions = points[2] * nx * ny * 2.0 + rows * nx * 3.0 + all * (rational ? 4.0 : 3.0);
  // H = (dN - N g) K: 45 (+ 18); T = w|J| P K^T, T g: 54 (+ 18)
  double at_point = 45.0 + 54.0 + (rational ? 36.0 : 0.0) + material_flops;
  // a map that only stretches along the axes, as the plate's: K has three entries
  if (method == structure::IntegrationMethod::affine) at_point = 9.0 + 12.0 + material_flops;
  // cofactors 27, |J| 5, K 10, w|J| 1; of X W and W: 1 / W, g, J, K / W
  if (recomputed) at_point += 43.0 + (rational ? 40.0 : 0.0);
  double bytes = vector_bytes(space) + 8.0 * space.control_point_count();  // columns read, and written to
  if (rational) bytes += 8.0 * space.control_point_count();
  if (recomputed) bytes += 24.0 * space.control_point_count();
  if (method == structure::IntegrationMethod::stored) bytes += 8.0 * all * (rational ? 13.0 : 10.0);
  return {bytes, fields * contractions * 2.0 * (p + 1.0) + all * at_point};
}

/// 8 bytes and the column's index for each entry.
inline Cost csr_cost(const nurbs::Space<3>& space, const CsrMatrix& K) {
  const auto entries = static_cast<double>(K.nonZeros());
  return {12.0 * entries + 4.0 * static_cast<double>(K.rows()) + vector_bytes(space), 2.0 * entries};
}

inline Cost block_cost(const nurbs::Space<3>& space, const BlockMatrix& K) {
  const auto blocks = static_cast<double>(K.blocks());
  return {(9 * 8.0 + 4.0) * blocks + 4.0 * static_cast<double>(K.begin.size()) + vector_bytes(space),
          18.0 * blocks};
}

}  // namespace benchmarks
