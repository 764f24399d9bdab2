// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/shear_compliance.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace contact {

namespace {

/// Of its components 11, 22, 12.
Eigen::Matrix2d symmetric(double first, double second, double both) {
  Eigen::Matrix2d matrix;
  matrix << first, both, both, second;
  return matrix;
}

}  // namespace

ShearCompliance::ShearCompliance(const coupling::LocalCompliance::Value& give,
                                 const SurfaceDirections& directions, const Vector3& n, double stiffness)
    : k_(stiffness), directions_(directions) {
  const Vector3 first_tangent = directions.tangents.col(0);
  t_[0] = (first_tangent - n.dot(first_tangent) * n).normalized();
  t_[1] = n.cross(t_[0]);
  const auto& [first, second, both] = give.along;
  c_ = symmetric(first.c, second.c, both.c);
  for (int d = 0; d < 2; ++d) change_[d] = symmetric(first.change[d], second.change[d], both.change[d]);
  const double mean = 0.5 * (first.c + second.c), half = 0.5 * (first.c - second.c);
  largest_share_ = k_ * (mean + std::sqrt(half * half + both.c * both.c));
}

// The body's speed is that of this step: one step late its damper would feed vibrations of the foot.
ShearCompliance::Step ShearCompliance::begin(const Start& start, const double* memory) {
  constexpr double kMostPerStep = 0.3;
  const Eigen::Map<const Eigen::Matrix<double, kMemory, 1>> kept(memory);
  const Eigen::Vector2d slip = on_surface(start.slip), own_speed = on_surface(start.own_speed),
                        stretch = on_surface(start.stretch);
  const Eigen::Vector2d body_speed =
      kept.isZero(0.0) ? Eigen::Vector2d(own_speed - slip) : on_surface(kept.tail<3>());
  const Eigen::Matrix2d shares = k_ * c_;
  const Eigen::Vector2d rate = (Eigen::Matrix2d::Identity() - shares).inverse() *
                               (slip + (shares * stretch - on_surface(kept.head<3>())) / start.dt);
  stretch_ = stretch + start.dt * rate;
  const double slowest =
      largest_share_ / k_ * start.dashpot / (1.0 - largest_share_) + kSlow * std::sqrt(start.inertia / k_);
  const double turn = std::min(start.dt / slowest, kMostPerStep);
  body_speed_ = body_speed + turn * (own_speed - rate - body_speed);
  body_speed_if_it_slips_ = body_speed + turn * (own_speed - slip - body_speed);
  const Eigen::Vector2d damped = own_speed - body_speed_;
  return {to_space(damped), to_space(start.dt * (rate - damped))};
}

// Where it slips the dent stays, and what the spring would have seen is nothing.
void ShearCompliance::end(const Vector3& stretch, double* memory) const {
  constexpr double kSame = 1e-9;
  const Eigen::Vector2d now = on_surface(stretch);
  const bool slips = now.squaredNorm() < (1.0 - 2.0 * kSame) * stretch_.squaredNorm();
  Eigen::Map<Vector3>{memory} = to_space(k_ * (c_ * now));
  Eigen::Map<Vector3>{memory + 3} = to_space(slips ? body_speed_if_it_slips_ : body_speed_);
}

Eigen::Vector2d ShearCompliance::force_along(const Vector3& stretch) const {
  const Eigen::Vector2d F = k_ * on_surface(stretch);
  return -0.5 * directions_.gradient({F.dot(change_[0] * F), F.dot(change_[1] * F)});
}

}  // namespace contact
