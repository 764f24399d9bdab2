// SPDX-License-Identifier: GPL-2.0-or-later
// Prescribed motion of a rigid body: the verbs of LIGGGHTS' fix move/mesh, integrated as LIGGGHTS does it.
// A motion is a rate, a velocity or an angular velocity as a function of time.  In the step from t to t + dt
// each motion is taken at its rate at t + dt, one after the other, so the path is that of the backward Euler
// rule; the rate at t + dt is also the wall's velocity in contacts.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "coupling/rigid_frame.h"
#include "coupling/value.h"

namespace coupling {

using nurbs::Vector3;

/// Time [time] since the motion began -> velocity [length/time].
struct Translation {
  std::function<Vector3(double time)> velocity;
};

/// Time [time] since the motion began -> angular velocity [1/time] about `axis` (unit vector) through
/// `centre` [length]; positive by the right hand.
struct Rotation {
  Vector3 centre, axis;
  std::function<double(double time)> rate;
  bool centre_follows;  ///< the motions before this one carry the centre along
};

struct Motion {
  std::string verb;
  std::variant<Translation, Rotation> rate;
};

/// c(t) = sum_j amplitude_j cos(2 pi t / period_j + phase_j).
struct Harmonics {
  std::vector<double> amplitude;   ///< [length] or [rad]
  std::vector<double> phase;       ///< [rad]
  std::vector<double> period;      ///< [time], not 0
  double rate(double time) const;  ///< dc/dt
};

/// The verbs.  Axes need not be unit vectors, but must not be zero; periods must not be zero.
Motion linear(const Vector3& velocity);
Motion linear_variable(const Value& vx, const Value& vy, const Value& vz);
/// x(t) = amplitude sin(2 pi t / period)
Motion wiggle(const Vector3& amplitude, double period);
Motion rotate(const Vector3& centre, const Vector3& axis, double period);
Motion rotate_variable(const Vector3& centre, const Vector3& axis, const Value& rate);
/// angle(t) = amplitude sin(2 pi t / period), amplitude in degrees
Motion riggle(const Vector3& centre, const Vector3& axis, double period, double amplitude_in_degrees);
Motion viblin(const Vector3& axis, const Harmonics& displacement);
Motion vibrot(const Vector3& centre, const Vector3& axis, const Harmonics& angle);

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
