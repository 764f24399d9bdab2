// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/spread_impulse.h"

#include <algorithm>
#include <cmath>

namespace coupling {

using nurbs::NodalVectors;

// Waves of the central difference scheme from rest: T(j) = cos(j alpha) with cos(alpha) = 1 - h^2/2 omega^2,
// by the recurrence T(j+1) = 2 cos(alpha) T(j) - T(j-1).
void SpreadImpulse::apply(NodalVectors& forces, double h, int count) {
  const structure::Halo& halo = solver_.halo();
  if (!halo.any(!halo.own(forces).isZero(0.0))) return;
  if (z_.cols() != forces.cols()) z_ = f_ = NodalVectors::Zero(3, forces.cols());
  for (int twice = 0; twice < 2; ++twice) average(forces, 0.5 * h * h, count);
}

// (1 + 2 sum of (1 - j/count) T(j)) / count = (sin(count alpha/2) / (count sin(alpha/2)))^2, Fejer's kernel.
void SpreadImpulse::average(NodalVectors& forces, double half_square, int count) {
  before_ = forces;
  multiply(before_, half_square);
  now_ = before_ - f_;
  forces /= count;
  for (int j = 1; j < count; ++j) {
    forces += 2.0 * (count - j) / (double(count) * count) * now_;
    if (j + 1 == count) break;
    multiply(now_, half_square);
    before_ = 2.0 * (now_ - f_) - before_;
    before_.swap(now_);
  }
}

/// f = half_square K M^-1 q, whole at own nodes; K holds springs, too.
void SpreadImpulse::multiply(const NodalVectors& q, double half_square) {
  solver_.mass().apply_inverse_mass(q, z_);
  z_ *= half_square;
  solver_.halo().owners_to_ghosts(z_);
  solver_.internal_forces(z_, f_);
}

double spread_share(double omega, double h, int count) {
  const double half_turn = std::asin(std::min(1.0, 0.5 * omega * h));
  if (half_turn == 0.0) return 1.0;
  const double ratio = std::sin(count * half_turn) / (count * std::sin(half_turn));
  return std::pow(ratio, 4);
}

}  // namespace coupling
