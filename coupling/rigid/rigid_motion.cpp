// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/rigid/rigid_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace coupling {

namespace {

/// Of a verb, in restart files.
double number_of(const std::string& verb) {
  return static_cast<double>(std::find(std::begin(kMotionVerbs), std::end(kMotionVerbs), verb) -
                             std::begin(kMotionVerbs));
}

/// x turned about the axis through the centre, by Rodrigues' formula for the small difference: what is
/// rounded off is random from step to step, so the distance from the centre does not drift.
Vector3 turned(const Vector3& x, const Vector3& centre, const Vector3& axis, double angle) {
  const Vector3 r = axis.cross(x - centre);
  const double half = std::sin(0.5 * angle);
  return x + (std::sin(angle) * r + 2.0 * half * half * axis.cross(r));
}

}  // namespace

void MovingFrame::stop() {
  frame_.velocity.setZero();
  frame_.angular_velocity.setZero();
}

void MovingFrame::translate(const Vector3& velocity, double dt) {
  frame_.origin += dt * velocity;
  frame_.velocity += velocity;
}

void MovingFrame::rotate(const Vector3& centre, const Vector3& axis, double rate, double dt) {
  orientation_ = Eigen::AngleAxisd(rate * dt, axis) * orientation_;
  orientation_.normalize();
  frame_.rotation = orientation_.toRotationMatrix();
  frame_.origin = turned(frame_.origin, centre, axis, rate * dt);
  frame_.velocity += rate * axis.cross(frame_.origin - centre);
  frame_.angular_velocity += rate * axis;
}

void MovingFrame::save(std::vector<double>& state) const {
  const auto append = [&](const auto& values) {
    state.insert(state.end(), values.data(), values.data() + values.size());
  };
  append(orientation_.coeffs());
  append(frame_.origin);
  append(frame_.velocity);
  append(frame_.angular_velocity);
}

void MovingFrame::load(const double* state) {
  orientation_.coeffs() = Eigen::Vector4d::Map(state);
  frame_.rotation = orientation_.toRotationMatrix();
  frame_.origin = Vector3::Map(state + 4);
  frame_.velocity = Vector3::Map(state + 7);
  frame_.angular_velocity = Vector3::Map(state + 10);
}

RigidMotion::RigidMotion(std::vector<Motion> motions) : motions_(std::move(motions)) {}

void RigidMotion::advance(MovingFrame& body, double dt) {
  time_ += dt;
  body.stop();
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    if (const auto* translation = std::get_if<Translation>(&motions_[k].rate)) {
      const Vector3 velocity = translation->velocity(time_);
      body.translate(velocity, dt);
      carry_centres(k + 1, [&](const Vector3& x) -> Vector3 { return x + dt * velocity; });
    } else {
      const Rotation& rotation = std::get<Rotation>(motions_[k].rate);
      const double rate = rotation.rate(time_);
      body.rotate(rotation.centre, rotation.axis, rate, dt);
      carry_centres(k + 1,
                    [&](const Vector3& x) { return turned(x, rotation.centre, rotation.axis, rate * dt); });
    }
  }
}

void RigidMotion::carry_centres(std::size_t first, const std::function<Vector3(const Vector3&)>& moved) {
  for (std::size_t k = first; k < motions_.size(); ++k) {
    Rotation* rotation = std::get_if<Rotation>(&motions_[k].rate);
    if (rotation && rotation->centre_follows) rotation->centre = moved(rotation->centre);
  }
}

void RigidMotion::save(std::vector<double>& state) const {
  state.push_back(time_);
  state.push_back(static_cast<double>(motions_.size()));
  for (const Motion& motion : motions_) {
    const Rotation* rotation = std::get_if<Rotation>(&motion.rate);
    const Vector3 centre = rotation ? rotation->centre : Vector3::Zero();
    state.insert(state.end(), {number_of(motion.verb), centre[0], centre[1], centre[2]});
  }
}

const double* RigidMotion::load(const double* begin, const double* end) {
  constexpr int kPerMotion = 4;
  const bool has_head = end - begin >= 2;
  const auto saved = has_head ? static_cast<std::ptrdiff_t>(begin[1]) : 0;
  if (!has_head || saved < 0 || end - begin - 2 < saved * kPerMotion)
    throw std::invalid_argument("the restart file's state of the wall's motion is cut off");
  const double* const first = begin + 2;
  const double* const last = first + saved * kPerMotion;

  bool same = saved == static_cast<std::ptrdiff_t>(motions_.size());
  for (std::size_t k = 0; same && k < motions_.size(); ++k)
    same = first[kPerMotion * k] == number_of(motions_[k].verb);
  if (!same) return last;
  time_ = begin[0];
  for (std::size_t k = 1; k < motions_.size(); ++k) {
    Rotation* rotation = std::get_if<Rotation>(&motions_[k].rate);
    if (rotation && rotation->centre_follows) rotation->centre = Vector3::Map(first + kPerMotion * k + 1);
  }
  return last;
}

}  // namespace coupling
