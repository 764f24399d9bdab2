// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/damped_approach.h"

#include <algorithm>
#include <cmath>

namespace contact {

// When it is over the dent is still there, and goes: the overlap becomes less, what w_ keeps.  Where it grows
// again it begins anew.
void DampedApproach::advance(double overlap, double of_particle, double of_surface, double dt) {
  if (x_ < 0.0) {
    if (overlap > w_)
      x_ = 0.0;
    else
      w_ = overlap;
  }
  const bool is_new = x_ == 0.0;
  if (is_new) u_ = of_surface, w_ = 0.0;
  if (x_ > 0.0) u_ += dt * w_;
  rate_ = of_particle + u_;
  if (x_ > 0.0) {
    x_ += dt * rate_;
    if (x_ <= 0.0) x_ = kOver, w_ = overlap;
  } else if (is_new && overlap > 0.0) {
    x_ = overlap;
  }
  if (x_ > 0.0) root_ = std::sqrt(std::sqrt(x_));
}

DampedApproach::Damper DampedApproach::damper(const DampedLaw& law, double dt) {
  constexpr double kMostPerStep = 0.3, kMostS = 0.9;
  const double gamma = dashpot(law), S = 1.5 * law.K * root_ * root_, c = std::max(law.give, 0.0);
  const double slowest =
      2.0 * c * gamma / (1.0 - std::min(c * S, kMostS)) + law.delay + kSlow * std::sqrt(law.inertia / S);
  turn_ = std::min(dt / slowest, kMostPerStep);
  const double stiffness = dt > 0.0 ? gamma * turn_ / dt : 0.0;
  return {gamma * rate_ - stiffness * x_, stiffness};
}

void DampedApproach::observe(double x, double dt) {
  const double e = x - x_;
  x_ += 3.0 * turn_ * e;
  u_ += 3.0 * turn_ * turn_ * e / dt;
  w_ += turn_ * turn_ * turn_ * e / (dt * dt);
}

}  // namespace contact
