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

// omega dt
double DampedApproach::turn(const DampedLaw& law, double dt) const {
  constexpr double kMostPerStep = 0.3, kMostS = 0.9;
  const double S = 1.5 * law.K * root_ * root_, c = std::max(law.give, 0.0);
  const double slowest = 2.0 * c * dashpot(law) / (1.0 - std::min(c * S, kMostS)) + law.delay +
                         kSlow * std::sqrt(law.inertia / S);
  return std::min(dt / slowest, kMostPerStep);
}

DampedApproach::Damper DampedApproach::damper(const DampedLaw& law, double dt) const {
  const double gamma = dashpot(law), stiffness = dt > 0.0 ? gamma * turn(law, dt) / dt : 0.0;
  return {gamma * rate_ - stiffness * x_, stiffness};
}

void DampedApproach::observe(const DampedLaw& law, double x, double dt) {
  const double turn = this->turn(law, dt), e = x - x_;
  x_ += 3.0 * turn * e;
  u_ += 3.0 * turn * turn * e / dt;
  w_ += turn * turn * turn * e / (dt * dt);
}

}  // namespace contact
