// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace nurbs {

/// Highest polynomial degree, as CAD has it in blends; fixes the size of every evaluation's stack buffers.
constexpr int kMaxDegree = 16;
/// That of volumes, whose buffers grow with its cube.
constexpr int kMaxVolumeDegree = 6;
constexpr int max_degree(int dim) { return dim == 3 ? kMaxVolumeDegree : kMaxDegree; }

}  // namespace nurbs
