// SPDX-License-Identifier: GPL-2.0-or-later
// Directions along a wall of patches as it now is, and how a foot moves along them with the centre above it:
// what changes along the surface is worked out with.  From (centre - S) . S_i = 0:
//   (S_i . S_j - delta . S_ij) d(xi_j) = S_i . d(centre) - sum over A of (R_A S_i - R_A,i delta) . d(X_A),
// so over a hill the foot is slower than the centre, and in a hollow faster; and what moves it by turning
// the surface below the centre, the last term, is a couple for a force that depends on the foot.  A foot on
// an edge, where (centre - S) . S_i is not 0, stays on it.
#pragma once

#include <Eigen/LU>
#include <array>

#include "coupling/contact/wall.h"

namespace contact {

struct SurfaceDirections {
  Eigen::Matrix<double, 3, 2> tangents;  ///< S_j of the patch, in space [length]
  Eigen::Matrix2d rates;                 ///< of the foot's parameters by S_i . d(centre) [1/length^2]
  nurbs::Indices<2> element;             ///< of the patch, that the foot is on

  /// At a foot of a wall that deforms; `delta`: from there to the centre, in space [length].
  void find(const Wall& wall, const nurbs::SurfacePoint& foot, const Vector3& delta) {
    const Vector3 in_frame = wall.to_frame_direction(delta);
    const auto [S_i, hessian, of_foot] = wall.slopes(foot, in_frame);
    rates = rates_of(S_i, hessian, in_frame);
    for (int j = 0; j < 2; ++j) tangents.col(j) = wall.to_space_direction(S_i.col(j));
    element = of_foot;
  }

  /// Of what changes with the parameters like this, the gradient with the centre's place along S_j.
  Eigen::Vector2d gradient(const std::array<double, 2>& change) const {
    return rates * Eigen::Vector2d(change[0], change[1]);
  }

 private:
  static Eigen::Matrix2d rates_of(const nurbs::Tangents& S_i, const Eigen::Matrix2d& hessian,
                                  const Vector3& delta) {
    constexpr double kStays = 1e-6;  // far above the round-off of a foot's search [rad]
    const Eigen::Vector2d slope = S_i.transpose() * delta;
    Eigen::Matrix2d rates = Eigen::Matrix2d::Zero();
    bool stays[2];
    for (int i = 0; i < 2; ++i)
      stays[i] = slope[i] * slope[i] > kStays * kStays * S_i.col(i).squaredNorm() * delta.squaredNorm();
    if (!stays[0] && !stays[1]) return hessian.inverse();
    for (int i = 0; i < 2; ++i)
      if (!stays[i]) rates(i, i) = 1.0 / hessian(i, i);
    return rates;
  }
};

}  // namespace contact
