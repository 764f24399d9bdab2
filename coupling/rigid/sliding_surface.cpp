// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/rigid/sliding_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace coupling {

SlidingSurface::SlidingSurface(std::variant<BeltVelocity, RollerVelocity> prescribed)
    : prescribed_(std::move(prescribed)) {
  if (!varies()) update();
}

bool SlidingSurface::varies() const {
  if (const auto* roller = std::get_if<RollerVelocity>(&prescribed_)) return roller->omega.varies();
  const auto& components = std::get<BeltVelocity>(prescribed_).components;
  return std::any_of(components.begin(), components.end(), [](const Value& v) { return v.varies(); });
}

void SlidingSurface::update() {
  if (const auto* roller = std::get_if<RollerVelocity>(&prescribed_)) {
    origin_ = roller->origin;
    angular_velocity_ = roller->omega() * roller->axis.normalized();
  } else {
    const auto& components = std::get<BeltVelocity>(prescribed_).components;
    for (int d = 0; d < 3; ++d) velocity_[d] = components[d]();
  }
}

Vector3 SlidingSurface::velocity(const Vector3& x, const Vector3& normal) const {
  const Vector3 v = velocity_ + angular_velocity_.cross(x - origin_);
  const Vector3 tangential = v - v.dot(normal) * normal;
  const double speed = v.norm(), tangential_speed = tangential.norm();
  if (tangential_speed <= 1e-9 * speed) return Vector3::Zero();
  return tangential * (speed / tangential_speed);
}

}  // namespace coupling
