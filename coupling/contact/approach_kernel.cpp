// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, as in feet_kernel.cpp.
#include "coupling/contact/approach_kernel.h"

namespace contact {
namespace approach {
namespace {

using B = ApproachBlock;
constexpr int kAll = B::kCapacity;
constexpr double kOver = -1.0;  // x of a contact that is over; w is the least overlap since

[[gnu::always_inline]] inline double least(double a, double b) { return b < a ? b : a; }
[[gnu::always_inline]] inline double most(double a, double b) { return b > a ? b : a; }

// When it is over the dent is still there, and goes: the overlap becomes less, what w keeps.  Where it grows
// again it begins anew.
void advance(ApproachBlock& b, double passed) {
  for (int k = 0; k < kAll; ++k) {
    const double overlap = b.overlap[k], of_surface = b.of_surface[k];
    const double kept = b.memory[B::kX][k], u = b.memory[B::kU][k], least_since = b.memory[B::kW][k];
    const bool was_over = kept < 0.0;
    const double over = overlap > least_since ? 0.0 : kept, x = was_over ? over : kept;
    const double held = was_over ? overlap : least_since, w = x == 0.0 ? 0.0 : held;
    const double gone_on = u + passed * w, going = x > 0.0 ? gone_on : u,
                 speed = x == 0.0 ? of_surface : going;
    const double rate = b.of_particle[k] + speed, moved = x + passed * rate;
    const double on = moved > 0.0 ? moved : kOver, begun = most(overlap, 0.0), off = x == 0.0 ? begun : x;
    const double now = x > 0.0 ? on : off, ended = now < 0.0 ? overlap : w;
    b.memory[B::kX][k] = b.x[k] = now;
    b.memory[B::kU][k] = speed;
    b.memory[B::kW][k] = x > 0.0 ? ended : w;
    b.memory[B::kTaken][k] = x > 0.0 ? b.memory[B::kTaken][k] : b.credit[k];
    b.memory[B::kForce][k] *= x > 0.0;
    const double overlap_before = was_over ? least_since : 0.0;
    b.memory[B::kOverlap][k] = x > 0.0 ? b.memory[B::kOverlap][k] : overlap_before;
    b.rate[k] = rate;
  }
  for (int k = 0; k < kAll; ++k) b.quarter[k] = __builtin_sqrt(__builtin_sqrt(most(b.x[k], 0.0)));
}

// The damper's force depends on what its force leaves of the overlap: of_damper + damper x, as
//   x - c (K x^(3/2) + damper x) = overlap + c of_damper.
void let_damper_turn(ApproachBlock& b, double passed) {
  constexpr double kMostPerStep = 0.3, kMostS = 0.9, kSlow = 0.15;
  const double per_time = passed > 0.0 ? 1.0 / passed : 0.0;
  for (int k = 0; k < kAll; ++k) {
    const double quarter = b.quarter[k], c = b.give[k], in = most(c, 0.0);
    const double gamma = b.damping[k] * __builtin_sqrt(__builtin_sqrt(b.radius[k])) * quarter,
                 S = 1.5 * b.K[k] * (quarter * quarter);
    const double slowest = 2.0 * in * gamma / (1.0 - least(in * S, kMostS)) + b.delay[k] +
                           kSlow * __builtin_sqrt(b.inertia[k] / S);
    const double turn = least(passed / slowest, kMostPerStep), damper = gamma * turn * per_time,
                 of_damper = gamma * b.rate[k] - damper * b.x[k], share = 1.0 - c * damper;
    b.dashpot[k] = gamma, b.stiffness[k] = S, b.turn[k] = turn;
    b.damper[k] = damper, b.of_damper[k] = of_damper;
    b.share[k] = share, b.left[k] = (b.overlap[k] + c * of_damper) / share;
  }
}

void let_nothing_turn(ApproachBlock& b) {
  for (int k = 0; k < kAll; ++k) {
    b.damper[k] = b.of_damper[k] = b.dashpot[k] = 0.0;
    b.share[k] = 1.0, b.left[k] = b.overlap[k];
  }
}

void know_law(ApproachBlock& b) {
  for (int k = 0; k < kAll; ++k) b.K[k] = b.constant[k] * __builtin_sqrt(b.radius[k]);
}

// Whether any goes on.  Who has come to its end stays there: nobody's digits depend on the others.  (Not
// inlined: it would be unrolled before it is vectorised.)
[[gnu::noinline]] bool newton_step(ApproachBlock& b) {
  constexpr double kSame = 3e-9;
  long moves = 0;  // as wide as what is compared: else it is not vectorised
  for (int k = 0; k < kAll; ++k) {
    const double q = b.q[k], q2 = q * q, next = (q * (q2 - 1.0) + b.e[k]) / (3.0 * q2 - 1.0),
                 change = b.moves[k] > 0.0 ? next : 0.0;
    b.q[k] = q - change;
    b.moves[k] = __builtin_fabs(change) > kSame * q ? 1.0 : 0.0;
    moves += __builtin_fabs(change) > kSame * q;
  }
  return moves > 0;
}

// x - c K x^(3/2) = left  with  q = (left/x)^(1/2),  e = c K left^(1/2)  is  q^3 - q + e = 0,  of which 1,
// where e = 0, is the largest root.  Newton's steps come down to it from above, and are quadratic: none comes
// after a small one.  They begin at its series,
//   1 - e/2 - 3/8 e^2 - 1/2 e^3 - 105/128 e^4 - ...,
// or, where that is none, above any.
void solve(ApproachBlock& b, double limit) {
  constexpr int kMostSteps = 60;
  constexpr double kSeries = -0.5;
  // s = 3/2 e/q is the limit at
  const double of_q = limit / 1.5, at_limit = of_q * __builtin_sqrt(1.0 - of_q);
  for (int k = 0; k < kAll; ++k) {
    const double asked = b.give[k] / b.share[k] * b.K[k] * __builtin_sqrt(most(b.left[k], 0.0));
    const double e = least(asked, at_limit);
    const double series = 1.0 - e * (0.5 + e * (0.375 + e * (0.5 + e * 0.8203125)));
    b.asked[k] = asked / at_limit, b.e[k] = e;
    b.q[k] = e > kSeries ? series : 1.0 - 0.5 * e;
    b.moves[k] = 1.0;
  }
  for (int step = 0; step < kMostSteps && newton_step(b); ++step) {
  }
}

// What is left of the overlap, if anything, behind the solution.
void answer(ApproachBlock& b, double limit) {
  for (int k = 0; k < kAll; ++k) {
    const double left = b.left[k], of_root = 1.0 / b.q[k],
                 own_root = __builtin_sqrt(most(left, 0.0)) * of_root,
                 own_x = left > 0.0 ? own_root * own_root : left;
    const double asked = b.asked[k], solved = 1.5 * b.e[k] * of_root, beyond = limit * asked,
                 s = asked < 1.0 ? solved : beyond;
    b.give_way[k] = 1.0 - b.share[k] * (1.0 - s);
    b.force[k] = b.K[k] * own_x * own_root + b.of_damper[k] + b.damper[k] * own_x;
    b.x[k] = own_x, b.root[k] = own_root;
  }
}

void elastic(ApproachBlock& b, const ApproachStep& step) {
  know_law(b);
  let_nothing_turn(b);
  solve(b, step.limit);
  answer(b, step.limit);
  for (int k = 0; k < kAll; ++k) {
    const double in_all = 1.0 / (1.0 - b.give_way[k]);
    b.rate[k] = (b.of_particle[k] + b.of_surface[k]) * in_all;
    b.stiffness[k] = 1.5 * b.K[k] * b.root[k];
    const double way = step.dt * __builtin_fabs(b.rate[k]);
    b.tangent[k] = 1.5 * b.K[k] * __builtin_sqrt(most(b.x[k], way)) * in_all;
  }
}

// Of what the contact is asked for as much as it may: it gives no energy that it has not taken, beside its
// credit, and less by what a spring of compliance kSpare c holds under its force, so that it ends by degrees,
//   kSpare c F^2/2 <= taken + (F_before + F)/2 (overlap - overlap_before).
// Between the roots, which have both signs or none, for what is left with no force at all.
void keep_account(ApproachBlock& b) {
  constexpr double kSpare = 0.3;
  double *const taken = b.memory[B::kTaken], *const before = b.memory[B::kForce],
                *const overlap = b.memory[B::kOverlap];
  for (int k = 0; k < kAll; ++k) {
    const double half_way = 0.5 * (b.overlap[k] - overlap[k]), left = taken[k] + before[k] * half_way,
                 spare = kSpare * most(b.give[k], 0.0),
                 root = __builtin_sqrt(most(half_way * half_way + 2.0 * spare * left, 0.0));
    const double top = half_way > 0.0 ? (half_way + root) / spare : 2.0 * left / (root - half_way),
                 bottom = half_way < 0.0 ? (half_way - root) / spare : -2.0 * left / (root + half_way);
    const double F = least(most(b.force[k], least(bottom, 0.0)), most(top, 0.0));
    b.force[k] = F;
    taken[k] = left + F * half_way;
    before[k] = F, overlap[k] = b.overlap[k];
  }
}

// The law is asked with the x that is kept, and with a rate by which its force is that of both.
void damped(ApproachBlock& b, const ApproachStep& step) {
  know_law(b);
  advance(b, step.passed);
  let_damper_turn(b, step.passed);
  solve(b, step.limit);
  answer(b, step.limit);
  keep_account(b);
  const double per_time = step.passed > 0.0 ? 1.0 / step.passed : 0.0;
  for (int k = 0; k < kAll; ++k) {
    const double x = b.memory[B::kX][k], root = b.quarter[k] * b.quarter[k], turn = b.turn[k];
    const double rate = (b.force[k] - b.K[k] * x * root) / b.dashpot[k], way = step.dt * __builtin_fabs(rate);
    b.tangent[k] = (1.5 * b.K[k] * __builtin_sqrt(most(x, way)) + b.damper[k]) / (1.0 - b.give_way[k]);
    b.x[k] = x, b.root[k] = root, b.rate[k] = rate;
    const double seen = b.overlap[k] + b.give[k] * b.force[k], e = x > 0.0 ? seen - x : 0.0;
    b.memory[B::kX][k] = x + 3.0 * turn * e;
    b.memory[B::kU][k] += 3.0 * turn * turn * e * per_time;
    b.memory[B::kW][k] += turn * turn * turn * e * (per_time * per_time);
  }
}

}  // namespace
}  // namespace approach

namespace NURBS_SIMD_LEVEL {

ApproachKernel approach_kernel() { return {approach::elastic, approach::damped}; }

}  // namespace NURBS_SIMD_LEVEL
}  // namespace contact
