// SPDX-License-Identifier: GPL-2.0-or-later
// A wall at rest whose surface slides within itself, such as a conveyor belt or a roller: LIGGGHTS' keywords
// surface_vel and surface_ang_vel of fix mesh/surface.
#pragma once

#include <array>
#include <variant>

#include "coupling/value.h"
#include "nurbs/types.h"

namespace coupling {

using nurbs::Vector3;

/// The same velocity everywhere [length/time].
struct BeltVelocity {
  std::array<Value, 3> components;
};

/// That of a rotation about `axis` (not zero) through `origin` [length], by the right hand.
struct RollerVelocity {
  Vector3 origin, axis;
  Value omega;  ///< [rad/time]
};

class SlidingSurface {
 public:
  explicit SlidingSurface(std::variant<BeltVelocity, RollerVelocity> prescribed);

  bool varies() const;
  /// Evaluates the prescribed values; they hold until the next call.
  void update();
  /// The prescribed velocity at x, turned into the tangent plane and as large as before, as in LIGGGHTS: a
  /// belt keeps its speed round a bend.  Zero where the prescribed velocity is normal to the surface (within
  /// 1e-9). `normal` is a unit vector of either sign.
  Vector3 velocity(const Vector3& x, const Vector3& normal) const;

 private:
  std::variant<BeltVelocity, RollerVelocity> prescribed_;
  Vector3 velocity_ = Vector3::Zero();  ///< at origin_
  Vector3 origin_ = Vector3::Zero(), angular_velocity_ = Vector3::Zero();
};

}  // namespace coupling
