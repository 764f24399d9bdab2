// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/spread_weight.h"

#include <algorithm>
#include <cmath>

namespace contact {

SpreadWeight SpreadLaw::weight(double x) const {
  constexpr double kWidth = SpreadWeight::kEnd - SpreadWeight::kBegin;
  const double s = 1.5 * K * c * std::sqrt(std::max(x, 0.0)), t = (s - SpreadWeight::kBegin) / kWidth;
  if (!(t > 0.0) || !(moment > 0.0)) return {};
  double theta = 1.0, by_t = 0.0, by_t_twice = 0.0;
  if (t < 1.0) {
    const double rest = 1.0 - t;
    theta = t * t * t * (10.0 - t * (15.0 - 6.0 * t));
    by_t = 30.0 * t * t * rest * rest;
    by_t_twice = 60.0 * t * rest * (1.0 - 2.0 * t);
  }
  const double t_by_log = 0.5 * s / kWidth;  // s goes as the root of x
  const double theta_by_log = by_t * t_by_log,
               theta_by_log_twice = by_t_twice * t_by_log * t_by_log + 0.5 * by_t * t_by_log;
  const double y = radius * x / (3.0 * moment), y4 = y * y * y * y, root = std::sqrt(std::sqrt(1.0 + y4));
  const double W = y / root, W_by_log = W / (1.0 + y4),
               W_by_log_twice = W_by_log * (1.0 - 5.0 * y4 / (1.0 + y4));
  SpreadWeight weight;
  weight.w = theta * W;
  weight.by_c = by_t * s / (kWidth * c) * W;
  weight.by_moment = -theta * W_by_log / moment;
  weight.by_log = theta_by_log * W + theta * W_by_log;
  weight.by_log_twice = theta_by_log_twice * W + 2.0 * theta_by_log * W_by_log + theta * W_by_log_twice;
  return weight;
}

// F goes as x^(3/2): F dw/dF = 2/3 dw/d(log x).
SpreadLaw::State SpreadLaw::at(double x) const {
  constexpr double kOfForce = 2.0 / 3.0;
  State state;
  state.x = x;
  state.weight = weight(x);
  const SpreadWeight& weight = state.weight;
  const double F = state.force = K * x * std::sqrt(x), c_w = give(weight.w), slope = one + weight.w * both;
  const double mu = state.mismatch = above + F * slope, mu_by_log = F * (1.5 * slope + weight.by_log * both);
  state.overlap = x - c_w * F - kOfForce * weight.by_log * mu - weight.w * above;
  const double by_log = x - 1.5 * c_w * F - 2.0 * weight.by_log * slope * F -
                        kOfForce * (weight.by_log_twice * mu + weight.by_log * mu_by_log) -
                        weight.by_log * above;
  state.s = 1.0 - by_log / x;
  return state;
}

// Newton's method from there.  As long as the surface stands while the force grows, what is far from the
// solution is no law (mu is not small there), and may have others.
SpreadLaw::State SpreadLaw::solve(double overlap, double from, double limit) const {
  constexpr double kSame = 1e-14, kFarthest = 0.25;
  constexpr int kMostSteps = 100;
  const double root = SpreadWeight::kBegin / (1.5 * K * c), begin = root * root;
  State state = at(begin);
  if (state.overlap >= overlap) {
    state.s = 0.0;
    return state;
  }
  if (from > begin) state = at(from);
  for (int step = 0; step < kMostSteps; ++step) {
    const double slope = std::max(1.0 - state.s, 1.0 - limit), farthest = kFarthest * state.x,
                 change = std::clamp((overlap - state.overlap) / slope, -farthest, farthest);
    const double next = std::max(state.x + change, begin);
    const bool is_same = std::abs(next - state.x) <= kSame * state.x;
    state = at(next);
    if (is_same) return state;
  }
  // None was found: where it looked last says nothing, a point force with that overlap does.
  state.s = std::max(1.5 * K * c * std::sqrt(std::max(overlap, 0.0)), limit);
  return state;
}

}  // namespace contact
