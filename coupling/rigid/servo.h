// SPDX-License-Identifier: GPL-2.0-or-later
// A wall that is pushed along an axis (or turned about it) until the particles push back with a given force
// (or torque): the controller of LIGGGHTS' mesh module servo.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "coupling/rigid/rigid_motion.h"
#include "coupling/value.h"

namespace coupling {

/// The words of the mesh module servo, with its defaults.
struct ServoSettings {
  enum class Controls { nothing, force, torque };

  /// A proportional controller whose gain depends on how near the target is, in place of PID.
  struct Automatic {
    double ratio;                             ///< near particles the wall moves at most ratio r_min per step
    std::function<double()> smallest_radius;  ///< r_min, of all particles [length]; infinite: there are none
    std::function<long()> near_particles;     ///< how many particles the wall may touch soon
  };

  Controls controls = Controls::nothing;
  Vector3 com = Vector3::Zero();   ///< centre of rotation, and reference point of the torque [length]
  Vector3 axis = Vector3::Zero();  ///< unit vector
  Value target;          ///< of the wall's push on the particles along the axis [force] or [force length]
  double vel_max = 0.0;  ///< largest speed of any point of the wall [length/time]
  double kp = 0.01, ki = 0.0, kd = 0.0;  ///< [-], [1/time], [time]
  std::optional<Automatic> automatic;
  bool integrate = true;  ///< false: the wall stands still
};

class Servo {
 public:
  /// `lever`: largest distance of any point of the wall from the axis [length], positive; it turns vel_max
  /// into an angular velocity if a torque is controlled.
  Servo(ServoSettings settings, double lever);

  /// May be changed between runs.
  ServoSettings& settings() { return settings_; }
  const ServoSettings& settings() const { return settings_; }
  void forget_past_errors() { error_sum_ = 0.0; }
  Vector3 com() const { return com_; }

  /// Before the first step of each run.
  void begin_run(double dt);
  /// One step with the rate that the last `control` has set.
  void advance(MovingFrame& body, double dt);
  /// From the force of the particles on the wall and its torque about com() to the next step's rate.  Throws
  /// std::invalid_argument if the target is zero.
  void control(const Vector3& force, const Vector3& torque, double dt);

  static constexpr int kStateSize = 6;
  void save(std::vector<double>& state) const;  ///< appends kStateSize numbers
  void load(const double* state);

 private:
  double pid_speed(double error, double value, double target_size, double dt);
  double automatic_speed(double relative_error) const;

  ServoSettings settings_;
  double lever_;  ///< 1 if a force is controlled
  Vector3 com_;
  double slow_ = 0.0;        ///< largest speed near particles, of the automatic mode [length/time]
  double speed_ = 0.0;       ///< along the axis, of the wall's outermost point if it turns [length/time]
  double error_sum_ = 0.0;   ///< integral of the error over time
  double last_value_ = 0.0;  ///< force or torque of the last step
};

}  // namespace coupling
