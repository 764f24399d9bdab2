// SPDX-License-Identifier: GPL-2.0-or-later
// How a rigid body may move: the verbs of LIGGGHTS' fix move/mesh.  A motion is a rate, a velocity or an
// angular velocity as a function of time.  A new verb is a function of this file and its name in the list at
// the end, and a row of the deck's words (liggghts-pkg/motion_words.cpp).
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "coupling/value.h"
#include "nurbs/types.h"

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
  std::vector<double> amplitude;  ///< [length] or [rad]
  std::vector<double> phase;      ///< [rad]
  std::vector<double> period;     ///< [time], not 0
  /// dc/dt
  double rate(double time) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < amplitude.size(); ++j) {
      const double omega = nurbs::kTwoPi / period[j];
      sum -= amplitude[j] * omega * std::sin(omega * time + phase[j]);
    }
    return sum;
  }
};

// The verbs.  Axes need not be unit vectors, but must not be zero; periods must not be zero.

inline Motion linear(const Vector3& velocity) {
  return {"linear", Translation{[=](double) { return velocity; }}};
}

inline Motion linear_variable(const Value& vx, const Value& vy, const Value& vz) {
  return {"linear/variable", Translation{[=](double) { return Vector3(vx(), vy(), vz()); }}};
}

/// x(t) = amplitude sin(2 pi t / period)
inline Motion wiggle(const Vector3& amplitude, double period) {
  const double omega = nurbs::kTwoPi / period;
  return {"wiggle",
          Translation{[=](double time) -> Vector3 { return omega * std::cos(omega * time) * amplitude; }}};
}

inline Motion rotate(const Vector3& centre, const Vector3& axis, double period) {
  const double omega = nurbs::kTwoPi / period;
  return {"rotate", Rotation{centre, axis.normalized(), [=](double) { return omega; }, true}};
}

inline Motion rotate_variable(const Vector3& centre, const Vector3& axis, const Value& rate) {
  return {"rotate/variable", Rotation{centre, axis.normalized(), [=](double) { return rate(); }, true}};
}

/// angle(t) = amplitude sin(2 pi t / period), amplitude in degrees
// The centres of riggle and vibrot stay where they are in space, as in LIGGGHTS 3.8.
inline Motion riggle(const Vector3& centre, const Vector3& axis, double period, double amplitude_in_degrees) {
  const double omega = nurbs::kTwoPi / period, amplitude = amplitude_in_degrees * EIGEN_PI / 180.0;
  return {"riggle", Rotation{centre, axis.normalized(),
                             [=](double time) { return amplitude * omega * std::cos(omega * time); }, false}};
}

inline Motion viblin(const Vector3& axis, const Harmonics& displacement) {
  const Vector3 direction = axis.normalized();
  return {"viblin", Translation{[=](double time) -> Vector3 { return displacement.rate(time) * direction; }}};
}

inline Motion vibrot(const Vector3& centre, const Vector3& axis, const Harmonics& angle) {
  return {"vibrot",
          Rotation{centre, axis.normalized(), [=](double time) { return angle.rate(time); }, false}};
}

/// Restart files hold a verb's place in this list.
constexpr const char* kMotionVerbs[] = {"linear",          "linear/variable", "wiggle", "rotate",
                                        "rotate/variable", "riggle",          "viblin", "vibrot"};

}  // namespace coupling
