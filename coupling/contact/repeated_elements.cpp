// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/repeated_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contact {

using nurbs::Vector3;

bool RepeatedElements::all(const Vector3& shift, const Vector3& d, double reach, const int* elements,
                           int count) {
  std::vector<Answer>& known = answers(shift);
  return std::all_of(elements, elements + count, [&](int element) {
    const Ball& ball = around(element);
    const double out = reach + ball.radius;
    if ((d - ball.centre).squaredNorm() > out * out) return true;
    if (element >= static_cast<int>(known.size())) known.resize(element + 1, kNotAsked);
    if (known[element] == kNotAsked) known[element] = is_another(shift, element) ? kYes : kNo;
    return known[element] == kYes;
  });
}

// Between its points an element bulges by less than it is wide.
const RepeatedElements::Ball& RepeatedElements::around(int element) {
  constexpr double kWider = 1.25;
  if (element >= static_cast<int>(balls_.size())) balls_.resize(element + 1);
  Ball& ball = balls_[element];
  if (ball.radius >= 0.0) return ball;
  shape_.points_of(element, points_);
  ball.radius = std::numeric_limits<double>::infinity();
  if (points_.empty()) return ball;
  ball.centre = Vector3::Zero();
  for (const Vector3& point : points_) ball.centre += point / static_cast<double>(points_.size());
  double farthest = 0.0;
  for (const Vector3& point : points_) farthest = std::max(farthest, (point - ball.centre).norm());
  ball.radius = kWider * farthest;
  return ball;
}

// A box that changes has ever new ones.
std::vector<RepeatedElements::Answer>& RepeatedElements::answers(const Vector3& shift) {
  constexpr std::size_t kMost = 125;  // of three periodic directions
  for (Shifted& known : shifted_)
    if (known.shift == shift) return known.answers;
  if (shifted_.size() == kMost) shifted_.clear();
  shifted_.push_back({shift, {}});
  return shifted_.back().answers;
}

bool RepeatedElements::is_another(const Vector3& shift, int element) {
  constexpr double kSame = 1e-6;  // of the wall's size: as files in single precision have it
  const search::Box bounds = shape_.bounds();
  const double same = kSame * (bounds.high - bounds.low).norm();
  const Ball& ball = around(element);
  if (!std::isfinite(ball.radius)) return false;
  const Vector3 centre = ball.centre + shift;  // of points that are all on the wall, if they are another's
  if (((centre - bounds.low).array() < -same).any() || ((centre - bounds.high).array() > same).any())
    return false;
  shape_.points_of(element, points_);
  for (Vector3& point : points_) point += shift;
  near_.clear();
  shape_.near(points_.front(), same, near_);
  return std::any_of(near_.begin(), near_.end(), [&](int other) {
    shape_.points_of(other, others_);
    return others_.size() == points_.size() &&
           std::all_of(points_.begin(), points_.end(), [&](const Vector3& point) {
             return std::any_of(others_.begin(), others_.end(),
                                [&](const Vector3& at) { return (at - point).squaredNorm() <= same * same; });
           });
  });
}

}  // namespace contact
