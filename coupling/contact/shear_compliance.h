// SPDX-License-Identifier: GPL-2.0-or-later
// Along the surface a mesh gives way beyond what the law knows, too: Mindlin's spring holds the give of both
// half-spaces.  With its stretch xi, its stiffness k and the matrix c along the surface, the particle has
// slid over the body beyond the dent by what it slides over the foot, u, and what the dent has moved:
//
//   d(xi) = du + d(w),   w = c k xi,
//
// as long as it sticks; so over a step, in which w was kept,  (1 - c k) d(xi) = du + c k xi - w.  Where it
// slips the law cuts xi, and w follows.  The potential of the spring behind c, 1/2 k xi^2 - 1/2 (k xi) . c
// (k xi), changes with the foot: its force along the surface is -1/2 (k xi) . grad c (k xi).
//
// A damper beside the spring must not see what the foot does at once: nodes there are light, and the dent
// that it makes is answered by the whole body later (damped_approach.h).  So it sees the particle's own speed
// less that of the body beyond the dent, which follows what the spring sees within the time
//
//   c gamma/(1 - c k) + kSlow (m/k)^(1/2).
#pragma once

#include <Eigen/Core>
#include <array>

#include "coupling/contact/surface_directions.h"
#include "coupling/local_compliance.h"

namespace contact {

class ShearCompliance {
 public:
  /// At a foot with the unit normal n; stiffness k [force/length].
  ShearCompliance(const coupling::LocalCompliance::Value& give, const SurfaceDirections& directions,
                  const Vector3& n, double stiffness);

  /// The largest share of c k, which has to be below 1.
  double largest_share() const { return largest_share_; }
  /// k / (1 - that) [force/length].
  double stiffness() const { return k_ / (1.0 - largest_share_); }
  static constexpr int kMemory = 6;  ///< numbers that a contact keeps; all are 0 in a new one

  /// What the law is to see of a step: the rate of slip of its damper [length/time], and what its spring
  /// slips more than that [length].
  struct Step {
    Vector3 rate, more;
  };
  /// Of what there is before it.
  struct Start {
    Vector3 slip, own_speed;  ///< rate of slip over the foot, and the particle's part of it [length/time]
    Vector3 stretch;          ///< [length]
    double dashpot, inertia;  ///< of the damper [force time/length]; of the particle along the surface [mass]
    double dt;                ///< [time]
  };
  Step begin(const Start& start, const double* memory);
  /// The stretch after it [length].
  void end(const Vector3& stretch, double* memory) const;
  /// The force on the particle that belongs to the change of c, in units of S_j [force/length].
  Eigen::Vector2d force_along(const Vector3& stretch) const;

 private:
  Eigen::Vector2d on_surface(const Vector3& v) const { return {t_[0].dot(v), t_[1].dot(v)}; }
  Vector3 to_space(const Eigen::Vector2d& v) const { return v[0] * t_[0] + v[1] * t_[1]; }

  static constexpr double kSlow = 0.15;

  double k_, largest_share_;
  std::array<Vector3, 2> t_;  // unit vectors along the surface
  SurfaceDirections directions_;
  Eigen::Matrix2d c_;                      // [length/force]
  std::array<Eigen::Matrix2d, 2> change_;  // with the parameters
  // Of this step:
  Eigen::Vector2d stretch_;                              // while it sticks
  Eigen::Vector2d body_speed_, body_speed_if_it_slips_;  // beyond the dent
};

}  // namespace contact
