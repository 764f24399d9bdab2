// SPDX-License-Identifier: GPL-2.0-or-later
// Patches of simple shapes.
#pragma once

#include "nurbs/patch.h"

namespace nurbs {

/// Axis-parallel block [origin, origin + size] [length], parametrised affinely by the given knot vectors (any
/// domain).
Volume box(const Vector3& origin, const Vector3& size, const std::array<KnotVector, 3>& knots);

/// Parallelogram origin + u edge_u + v edge_v, u, v in [0,1], parametrised affinely; the normal is edge_u x
/// edge_v.
Surface plane(const Vector3& origin, const Vector3& edge_u, const Vector3& edge_v,
              const std::array<KnotVector, 2>& knots);

}  // namespace nurbs
