// SPDX-License-Identifier: GPL-2.0-or-later
// Names shared by the geometry kernel.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nurbs/max_degree.h"

namespace nurbs {

using Vector3 = Eigen::Vector3d;

/// One column per control point (3 x n, contiguous xyz): positions [length], velocities, forces.
/// Geometry owns topology; these are always passed in, so reference, current and trial share one topology.
using NodalVectors = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// x, y, z of the first point, then of the second: as one column each.
inline NodalVectors nodal_vectors(const std::vector<double>& numbers) {
  return NodalVectors::Map(numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
}

constexpr double kPi = EIGEN_PI, kTwoPi = 2.0 * kPi;

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

}  // namespace nurbs
