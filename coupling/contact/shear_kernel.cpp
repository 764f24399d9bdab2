// SPDX-License-Identifier: GPL-2.0-or-later
// Compiled once for each instruction set, into the namespace NURBS_SIMD_LEVEL.  Everything else here has
// internal linkage, as in feet_kernel.cpp.
#include "coupling/contact/shear_kernel.h"

namespace contact {
namespace shear {
namespace {

using Lanes = ShearBlock::Lanes;
constexpr int kAll = ShearBlock::kCapacity;

[[gnu::always_inline]] inline double least(double a, double b) { return b < a ? b : a; }

[[gnu::always_inline]] inline double dot(const Lanes* a, const Lanes* b, int k) {
  return a[0][k] * b[0][k] + a[1][k] * b[1][k] + a[2][k] * b[2][k];
}

void find_directions(ShearBlock& b) {
  for (int k = 0; k < kAll; ++k) {
    const double n[3] = {b.normal[0][k], b.normal[1][k], b.normal[2][k]}, up = dot(b.normal, b.first, k);
    const double x = b.first[0][k] - up * n[0], y = b.first[1][k] - up * n[1], z = b.first[2][k] - up * n[2];
    const double scale = 1.0 / __builtin_sqrt(x * x + y * y + z * z);
    const double t[3] = {scale * x, scale * y, scale * z};
    for (int d = 0; d < 3; ++d) b.t[0][d][k] = t[d];
    b.t[1][0][k] = n[1] * t[2] - n[2] * t[1];
    b.t[1][1][k] = n[2] * t[0] - n[0] * t[2];
    b.t[1][2][k] = n[0] * t[1] - n[1] * t[0];
  }
}

void find_shares(ShearBlock& b) {
  for (int k = 0; k < kAll; ++k) {
    const double mean = 0.5 * (b.give[0][k] + b.give[1][k]), half = 0.5 * (b.give[0][k] - b.give[1][k]),
                 both = b.give[2][k];
    b.share[k] = b.stiffness[k] * (mean + __builtin_sqrt(half * half + both * both));
    // dampers of both directions have the same share of critical damping
    b.dashpot[k] = b.normal_dashpot[k] * __builtin_sqrt(b.stiffness[k] / b.normal_stiffness[k]);
  }
}

// The body's speed is that of this step: one step late its damper would feed vibrations of the foot.
void begin(ShearBlock& b, double dt) {
  constexpr double kMostPerStep = 0.3, kSlow = 0.15;
  find_directions(b);
  find_shares(b);
  const double per_time = 1.0 / dt;
  for (int k = 0; k < kAll; ++k) {
    double kept = 0.0;
    for (const Lanes& number : b.memory) kept += __builtin_fabs(number[k]);
    const double stiffness = b.stiffness[k], c_12 = stiffness * b.give[2][k],
                 c_ii[2] = {stiffness * b.give[0][k], stiffness * b.give[1][k]};
    double slip[2], own[2], body[2], stretch[2], dent[2];
    for (int i = 0; i < 2; ++i) {
      slip[i] = dot(b.t[i], b.slip, k);
      own[i] = slip[i] + dot(b.t[i], b.wall, k);
      stretch[i] = dot(b.t[i], b.stretch, k);
      dent[i] = dot(b.t[i], b.memory, k);
      const double known = dot(b.t[i], b.memory + 3, k);
      body[i] = kept > 0.0 ? known : own[i] - slip[i];
    }
    double towards[2];
    for (int i = 0; i < 2; ++i)
      towards[i] = slip[i] + (c_ii[i] * stretch[i] + c_12 * stretch[1 - i] - dent[i]) * per_time;
    const double of_all = 1.0 / ((1.0 - c_ii[0]) * (1.0 - c_ii[1]) - c_12 * c_12);
    const double slowest = b.share[k] / stiffness * b.dashpot[k] / (1.0 - b.share[k]) +
                           kSlow * __builtin_sqrt(b.inertia[k] / stiffness);
    const double turn = least(dt / slowest, kMostPerStep);
    double damped[2], more[2];
    for (int i = 0; i < 2; ++i) {
      const double rate = of_all * ((1.0 - c_ii[1 - i]) * towards[i] + c_12 * towards[1 - i]);
      const double now = body[i] + turn * (own[i] - rate - body[i]);
      b.stuck[i][k] = stretch[i] + dt * rate;
      b.body[i][k] = now;
      b.body_slips[i][k] = body[i] + turn * (own[i] - slip[i] - body[i]);
      damped[i] = own[i] - now - slip[i];
      more[i] = dt * (rate - (own[i] - now));
    }
    for (int d = 0; d < 3; ++d) {
      b.more_rate[d][k] = damped[0] * b.t[0][d][k] + damped[1] * b.t[1][d][k];
      b.more[d][k] = more[0] * b.t[0][d][k] + more[1] * b.t[1][d][k];
    }
  }
}

// Where it slips the dent stays, and what the spring would have seen is nothing.
void end(ShearBlock& b) {
  constexpr double kSame = 1e-9;
  for (int k = 0; k < kAll; ++k) {
    const double stiffness = b.stiffness[k];
    const double x = dot(b.t[0], b.stretch, k), y = dot(b.t[1], b.stretch, k), F = stiffness * x,
                 G = stiffness * y;
    const double stuck = b.stuck[0][k] * b.stuck[0][k] + b.stuck[1][k] * b.stuck[1][k];
    const double sticks[2] = {b.body[0][k], b.body[1][k]},
                 slips[2] = {b.body_slips[0][k], b.body_slips[1][k]};
    const bool slip = x * x + y * y < (1.0 - 2.0 * kSame) * stuck;
    const double dent[2] = {b.give[0][k] * F + b.give[2][k] * G, b.give[2][k] * F + b.give[1][k] * G};
    const double body[2] = {slip ? slips[0] : sticks[0], slip ? slips[1] : sticks[1]};
    const double of_foot[2] = {dot(b.t[0], b.wall, k), dot(b.t[1], b.wall, k)};
    for (int d = 0; d < 3; ++d) {
      b.memory[d][k] = dent[0] * b.t[0][d][k] + dent[1] * b.t[1][d][k];
      b.memory[3 + d][k] =
          b.wall[d][k] + (body[0] - of_foot[0]) * b.t[0][d][k] + (body[1] - of_foot[1]) * b.t[1][d][k];
    }
    for (int j = 0; j < 2; ++j)
      b.along[j][k] = -0.5 * (b.gradient[0][j][k] * (F * F) + b.gradient[1][j][k] * (G * G) +
                              2.0 * b.gradient[2][j][k] * (F * G));
  }
}

}  // namespace
}  // namespace shear

namespace NURBS_SIMD_LEVEL {

ShearKernel shear_kernel() { return {shear::begin, shear::end}; }

}  // namespace NURBS_SIMD_LEVEL
}  // namespace contact
