// SPDX-License-Identifier: GPL-2.0-or-later
// Of ComplianceCorrection what forces need that are spread about their foot.
#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/contact/compliance.h"

namespace contact {

/// What is about the foot now; of what links have done for the contact's own force as much is taken back as
/// at the foot.
ComplianceCorrection::Spread& ComplianceCorrection::know_spread(const Contact& contact, Before& before) {
  Spread& spread = spreads_[&before - before_.data()];
  if (before.spread) return spread;
  before.spread = &spread;
  spread.mismatch = 0.0;
  compliance_.find_spread(contact.foot, before.directions.element, spread.give);
  const coupling::FootSlopes foot(wall_.surface(), contact.foot);
  const coupling::NetSpread::Sums sums = net_spread_->sums(foot.slopes(), wall_.control_points());
  const double taken = spread.give.taken_one + before.expected_spread * spread.give.taken_both;
  spread.beside = wall_.to_space_direction(sums.value) - taken * before.expected;
  for (int j = 0; j < 2; ++j) spread.beside_slopes.col(j) = wall_.to_space_direction(sums.slopes.col(j));
  spread.beside_velocity =
      wall_.to_space_direction(net_spread_->sum(foot.slopes().values, wall_.velocities()));
  spread.above = before.n.dot(spread.beside) - spread.give.height.c;
  return spread;
}

SpreadLaw ComplianceCorrection::spread_law(const Before& before) {
  const ApproachBlock& block = *before.block;
  const coupling::LocalCompliance::Spread& give = before.spread->give;
  const int lane = before.lane;
  return {block.constant[lane] * std::sqrt(block.radius[lane]),
          block.radius[lane],
          before.give.normal.c + before.give.taken,
          give.one.c + give.taken_one,
          give.both.c + give.taken_both,
          give.moment.c,
          before.spread->above};
}

/// Where the surface is met moves as its mean does.
void ComplianceCorrection::move_with_spread(const ParticleView& particles, const Time& now, Contact& contact,
                                            Before& before) {
  Vector3 velocity = before.w * before.spread->beside_velocity;
  if (!now.is_setup && now.dt > 0.0) {
    const double change = before.w - memory_of(particles, contact)[kSpreadLast];
    velocity += change / now.dt * across(before.spread->beside, before.n);
  }
  before.met_velocity += velocity;
  contact.wall_velocity += velocity;
  before.approach += before.n.dot(velocity);
}

void ComplianceCorrection::spread_elastic(const ParticleView& particles, const Time& now, Contact& contact,
                                          Before& before) {
  const int lane = before.lane;
  ApproachBlock& block = elastic_;
  if (block.give_way[lane] < SpreadWeight::kBegin) return;
  Spread& spread = know_spread(contact, before);
  const SpreadLaw law = spread_law(before);
  const double of_force = before.expected.norm() / law.K, root = std::cbrt(of_force);
  const SpreadLaw::State state = law.solve(block.overlap[lane], root * root, kLargest);
  if (state.s == 0.0) return;
  spread.weight = state.weight;
  spread.mismatch = state.mismatch;
  before.w = state.weight.w;
  move_with_spread(particles, now, contact, before);
  block.x[lane] = state.x, block.root[lane] = std::sqrt(state.x);
  block.force[lane] = state.force, block.give_way[lane] = state.s;
  const double in_all = 1.0 / (1.0 - state.s), rate = before.approach * in_all, way = now.dt * std::abs(rate);
  block.rate[lane] = rate;
  block.stiffness[lane] = 1.5 * law.K * block.root[lane];
  block.tangent[lane] = 1.5 * law.K * std::sqrt(std::max(state.x, way)) * in_all;
}

// By what has been kept of x, before it moves on: a damped contact has no potential anyhow.  Its account is
// of the work that its force does, w of each step with what the surface does then.
void ComplianceCorrection::spread_damped(const ParticleView& particles, const Time& now, Contact& contact,
                                         Before& before) {
  ApproachBlock& block = damped_;
  const int lane = before.lane;
  const double x = block.memory[ApproachBlock::kX][lane];
  const double* const forces = memory_of(particles, contact);
  const double last = forces[kSpreadLast];
  const double S_over_root = 1.5 * block.constant[lane] * block.give[lane];  // over that of the radius
  constexpr double kBegin = SpreadWeight::kBegin;
  const bool begins = x > 0.0 && S_over_root * S_over_root * block.radius[lane] * x > kBegin * kBegin;
  if (!begins && last == 0.0) return;
  Spread& spread = know_spread(contact, before);
  const SpreadLaw law = spread_law(before);
  if (!now.is_setup) {
    spread.weight = x > 0.0 ? law.weight(x) : SpreadWeight();
    before.w = spread.weight.w;
    const double force_before = block.memory[ApproachBlock::kForce][lane], of_step = before.w - last;
    block.memory[ApproachBlock::kOverlap][lane] += of_step * forces[kAbove];
    block.memory[ApproachBlock::kTaken][lane] -=
        0.5 * force_before * of_step * (spread.above - forces[kAbove]);
  } else {
    spread.weight = {};
    before.w = last;
  }
  block.overlap[lane] += before.w * spread.above;
  block.give[lane] = law.give(before.w);
  move_with_spread(particles, now, contact, before);
  block.of_surface[lane] += before.n.dot(before.w * spread.beside_velocity);
}

double ComplianceCorrection::give_along(const Before& before, int c, Eigen::Vector2d& gradient) {
  const coupling::LocalCompliance::Component& of_point = before.give.along[c];
  const double w = before.w;
  if (w == 0.0) {
    gradient = before.directions.gradient(of_point.change);
    return of_point.c;
  }
  const auto &one = before.spread->give.along_one[c], &both = before.spread->give.along_both[c];
  std::array<double, 2> change;
  for (int j = 0; j < 2; ++j) change[j] = of_point.change[j] + w * (2.0 * one.change[j] + w * both.change[j]);
  gradient = before.directions.gradient(change);
  return of_point.c + w * (2.0 * one.c + w * both.c);
}

// -dU with the foot, beside what a point force has (theory.md).
Eigen::Vector2d ComplianceCorrection::spread_along(const Contact& contact, const Before& before, double F) {
  const Spread& spread = *before.spread;
  const coupling::LocalCompliance::Spread& give = spread.give;
  const double w = before.w;
  const Vector3 tilted = across(spread.beside, before.n) / contact.distance;
  std::array<double, 2> change;
  for (int j = 0; j < 2; ++j) {
    const double of_give = w * (2.0 * give.one.change[j] + w * give.both.change[j]),
                 of_weight = spread.weight.by_c * (before.give.normal.change[j] + give.taken.change[j]) +
                             spread.weight.by_moment * give.moment.change[j],
                 of_place = before.n.dot(spread.beside_slopes.col(j)) -
                            before.directions.tangents.col(j).dot(tilted) - give.height.change[j];
    change[j] = 0.5 * F * F * of_give + F * spread.mismatch * of_weight + F * w * of_place;
  }
  return -before.directions.gradient(change);
}

}  // namespace contact
