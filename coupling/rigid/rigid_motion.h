// SPDX-License-Identifier: GPL-2.0-or-later
// Prescribed motion of a rigid body, integrated as LIGGGHTS' fix move/mesh does it.  In the step from t to t
// + dt each motion is taken at its rate at t + dt, one after the other, so the path is that of the backward
// Euler rule; the rate at t + dt is also the wall's velocity in contacts.
#pragma once

#include <functional>
#include <vector>

#include "coupling/rigid/motion_verbs.h"
#include "coupling/rigid_frame.h"

namespace coupling {

/// A body frame that is moved by finite increments; the rotation stays orthogonal for any number of them.
class MovingFrame {
 public:
  const RigidFrame& frame() const { return frame_; }

  /// Velocities are zero until the next increment.
  void stop();
  void translate(const Vector3& velocity, double dt);
  void rotate(const Vector3& centre, const Vector3& axis, double rate, double dt);

  static constexpr int kStateSize = 13;
  void save(std::vector<double>& state) const;  ///< appends kStateSize numbers
  void load(const double* state);

 private:
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  RigidFrame frame_;
};

/// Motions in the order in which they act.  The body moves with all of them, and so do the centres of those
/// rotations that come later in the order.
class RigidMotion {
 public:
  explicit RigidMotion(std::vector<Motion> motions = {});

  bool empty() const { return motions_.empty(); }
  /// One step of dt [time].
  void advance(MovingFrame& body, double dt);

  /// Clock and centres.
  void save(std::vector<double>& state) const;
  /// Reads from a state saved at `begin`, up to `end`, and returns where it ends.  Motions with other verbs
  /// than the saved ones begin anew.  Throws std::invalid_argument if the state is cut off.
  const double* load(const double* begin, const double* end);

 private:
  /// Moves the centres of the motions from `first` on.
  void carry_centres(std::size_t first, const std::function<Vector3(const Vector3&)>& moved);

  std::vector<Motion> motions_;
  double time_ = 0.0;
};

}  // namespace coupling
