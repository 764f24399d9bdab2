// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/damped_approach.h"

#include <algorithm>
#include <cmath>

namespace contact {

// Where it is over it begins anew if the bodies turn round before they have come apart.
void DampedApproach::advance(double overlap, double of_particle, double of_surface, double dt) {
  const bool is_new = x_ == 0.0;
  if (is_new) u_ = of_surface;
  if (x_ > 0.0) u_ += dt * w_;
  rate_ = of_particle + u_;
  if (x_ > 0.0) {
    x_ += dt * rate_;
    if (x_ <= 0.0) x_ = kOver;
  } else if (overlap > 0.0 && (is_new || rate_ > 0.0)) {
    x_ = overlap, w_ = 0.0;
  }
  if (x_ > 0.0) root_ = std::sqrt(std::sqrt(x_));
}

void DampedApproach::observe(const DampedLaw& law, double x, double dt) {
  constexpr double kMostPerStep = 0.3, kMostS = 0.9;
  const double S = 1.5 * law.K * root_ * root_, c = std::max(law.give, 0.0);
  const double slowest =
      c * dashpot(law) / (1.0 - std::min(c * S, kMostS)) + law.delay + kSlow * std::sqrt(law.inertia / S);
  const double turn = std::min(dt / slowest, kMostPerStep), e = x - x_;
  x_ += 3.0 * turn * e;
  u_ += 3.0 * turn * turn * e / dt;
  w_ += turn * turn * turn * e / (dt * dt);
}

}  // namespace contact
