// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/rigid/servo.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace coupling {

Servo::Servo(ServoSettings settings, double lever)
    : settings_(std::move(settings)),
      lever_(settings_.controls == ServoSettings::Controls::torque ? lever : 1.0),
      com_(settings_.com) {}

void Servo::begin_run(double dt) {
  if (!settings_.automatic) return;
  const double r_min = settings_.automatic->smallest_radius();
  slow_ = std::isfinite(r_min) ? settings_.automatic->ratio * r_min / dt : settings_.vel_max;
}

void Servo::advance(MovingFrame& body, double dt) {
  body.stop();
  if (!settings_.integrate) return;
  const double rate = speed_ / lever_;
  if (settings_.controls == ServoSettings::Controls::torque) {
    body.rotate(com_, settings_.axis, rate, dt);
  } else {
    body.translate(rate * settings_.axis, dt);
    com_ += dt * (rate * settings_.axis);
  }
}

// The particles push back, so the wall feels -target when it has reached its aim, and it moves against the
// error.
void Servo::control(const Vector3& force, const Vector3& torque, double dt) {
  const bool turns = settings_.controls == ServoSettings::Controls::torque;
  const double value = (turns ? torque : force).dot(settings_.axis);
  if (!settings_.integrate) {
    last_value_ = value;  // the speed stays for when it goes on, as LIGGGHTS has it
    return;
  }
  const double target = -settings_.target();
  if (target == 0.0 || !std::isfinite(target))
    throw std::invalid_argument("the servo's target_val has become 0 or infinite, expected another number");
  const double error = target - value;
  speed_ = settings_.automatic ? automatic_speed(error / std::abs(target))
                               : pid_speed(error, value, std::abs(target), dt);
}

// The derivative is that of the force, not of the error: a jump of the target gives no spike.
double Servo::pid_speed(double error, double value, double target_size, double dt) {
  const ServoSettings& s = settings_;
  error_sum_ += error * dt;
  const double change = -(value - last_value_) / dt;
  last_value_ = value;
  const double output = (s.kp * error + s.ki * error_sum_ + s.kd * change) / target_size;
  if (std::abs(output) <= 1.0) return -s.vel_max * output;

  // Saturated: the integral is set to what would just reach the limit, so it does not wind up.
  const double limit = std::copysign(1.0, output);
  if (s.ki > 0.0) error_sum_ = (limit * target_size - s.kp * error) / s.ki;
  return -s.vel_max * limit;
}

double Servo::automatic_speed(double relative_error) const {
  if (settings_.automatic->near_particles() == 0)
    return -settings_.vel_max * std::clamp(relative_error, -1.0, 1.0);
  constexpr double kNear = 0.9, kFar = 1.0, kFine = 0.1;  // as in LIGGGHTS
  const double size = std::abs(relative_error);
  const double blend = std::clamp((size - kNear) / (kFar - kNear), 0.0, 1.0);
  const double gain = slow_ * (kFine + (1.0 - kFine) * blend);
  return -std::clamp(gain * relative_error, -slow_, slow_);
}

void Servo::save(std::vector<double>& state) const {
  state.insert(state.end(), {com_[0], com_[1], com_[2], speed_, error_sum_, last_value_});
}

void Servo::load(const double* state) {
  com_ = Vector3::Map(state);
  speed_ = state[3];
  error_sum_ = state[4];
  last_value_ = state[5];
}

}  // namespace coupling
