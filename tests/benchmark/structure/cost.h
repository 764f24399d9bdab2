// SPDX-License-Identifier: GPL-2.0-or-later
// What one evaluation must read and work out, counted from the formulas: the least that memory and
// arithmetic allow, whatever caches do.
#pragma once

#include "nurbs/patch.h"
#include "stiffness.h"

namespace benchmarks {

struct Cost {
  double bytes = 0.0;  ///< to and from memory, once through the data
  double flops = 0.0;  ///< additions and multiplications
};

/// Of P(H) at one point, scaled by w|J|.
struct MaterialFlops {
  /// trace 2, lambda tr 1; diagonal 3 (2 mu e + lambda tr); the others 3 (a + b) mu; scaled 9.
  static constexpr double kLinear = 2 + 1 + 6 + 6 + 9;
  /// E = (H + H^T + H^T H) / 2: 6 (5 + 3); S: 2 + 1 + 6 + 3; P = S + H S: 9 x 6; scaled 9.
  static constexpr double kSaintVenantKirchhoff = 48 + 12 + 54 + 9;
};

/// Displacements read, forces read and written.
inline double vector_bytes(const nurbs::Space<3>& space) {
  return 3.0 * 8.0 * 3.0 * space.control_point_count();
}

/// The plain element loop: dR/dX [point][3][padded functions], w|J| and nodes are read, and at each point
/// H = sum u_A (x) dR_A/dX and f_A += P dR_A/dX take 9 multiplications and 9 additions per function each.
inline Cost plain_cost(const nurbs::Space<3>& space, int points, double material_flops) {
  const int n = space.functions_per_element(), padded = (n + 3) / 4 * 4;
  const double elements = space.element_count();
  return {elements * (points * (24.0 * padded + 8.0) + 4.0 * n) + vector_bytes(space),
          elements * points * (36.0 * padded + material_flops)};
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
