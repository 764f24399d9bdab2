// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of an oscillator beside closed forms: free, under a step, under a ramp, with any damping.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/time/oscillator.h"

namespace {

using structure::Oscillator;
using structure::OscillatorStep;

constexpr double kMass = 2.0, kOmega = 3.0, kStiffness = kMass * kOmega * kOmega;

struct Motion {
  double y, v;
};

/// From (y, v) at t = 0 under F = F0 + slope t (Craig & Kurdila 2006, secs. 3.1, 5.1 and 5.2).
Motion closed_form(double zeta, double y, double v, double F0, double slope, double t) {
  const double c = 2.0 * zeta * kOmega;  // y'' + c y' + omega^2 y = F / m
  const double at_rest = (F0 - c * kMass * slope / kStiffness) / kStiffness, drift = slope / kStiffness;
  const double a = y - at_rest, b = v - drift, decay = std::exp(-0.5 * c * t);
  if (zeta == 1.0) {
    const double rate = b + kOmega * a;
    const double free = decay * (a + rate * t);
    return {at_rest + drift * t + free, drift + decay * rate - kOmega * free};
  }
  const double root = kOmega * std::sqrt(std::abs(1.0 - zeta * zeta)), rate = (b + 0.5 * c * a) / root;
  const double cosine = zeta < 1.0 ? std::cos(root * t) : std::cosh(root * t),
               sine = zeta < 1.0 ? std::sin(root * t) : std::sinh(root * t), turn = zeta < 1.0 ? -root : root;
  const double free = decay * (a * cosine + rate * sine);
  return {at_rest + drift * t + free,
          drift + decay * (a * turn * sine + rate * root * cosine) - 0.5 * c * free};
}

OscillatorStep step_of(double zeta, double dt) {
  return {Oscillator{kMass, 2.0 * zeta * kOmega * kMass, kStiffness}, dt};
}

TEST(Oscillator, StepsAreExactUnderStepsAndRamps) {
  for (const double zeta : {0.0, 0.02, 0.7, 1.0, 4.0})
    for (const double dt : {1e-4, 0.1, 1.0, 3.0}) {
      const double F0 = 0.7, slope = -0.3;
      double y = 0.2, v = -1.1;
      const OscillatorStep step = step_of(zeta, dt);
      for (int n = 0; n < 4; ++n) {
        step.advance(F0 + slope * n * dt, F0 + slope * (n + 1) * dt, y, v);
        const Motion exact = closed_form(zeta, 0.2, -1.1, F0, slope, (n + 1) * dt);
        const double scale = 1.0 + std::abs(exact.y);
        EXPECT_NEAR(y, exact.y, 1e-12 * scale) << "zeta " << zeta << ", dt " << dt << ", step " << n;
        EXPECT_NEAR(v, exact.v, 1e-12 * kOmega * scale) << "zeta " << zeta << ", dt " << dt << ", step " << n;
      }
    }
}

TEST(Oscillator, WorkOfTheForceIsWhatTheEnergyGainsWithoutDamping) {
  const OscillatorStep step = step_of(0.0, 0.37);
  double y = 0.3, v = 0.4, work = 0.0;
  const double start = step.oscillator().energy(y, v);
  const double F[] = {1.0, -2.0, 0.5, 4.0, 4.0};
  for (int n = 0; n < 4; ++n) work += step.advance(F[n], F[n + 1], y, v);
  EXPECT_GT(std::abs(work), 0.1);
  EXPECT_NEAR(step.oscillator().energy(y, v) - start, work, 1e-14);
}

TEST(Oscillator, WorkLessEnergyIsWhatDampingTakes) {
  const int parts = 2000;
  const double dt = 0.8, zeta = 0.3, F0 = 1.0, F1 = -2.0;
  const OscillatorStep whole = step_of(zeta, dt), fine = step_of(zeta, dt / parts);
  double y = 0.3, v = 0.4;
  double y_fine = y, v_fine = v, lost = 0.0;
  const double start = whole.oscillator().energy(y, v);
  for (int n = 0; n < parts; ++n) {
    const double v_before = v_fine;
    fine.advance(F0 + (F1 - F0) * n / parts, F0 + (F1 - F0) * (n + 1) / parts, y_fine, v_fine);
    lost += whole.oscillator().damping * 0.5 * (v_before * v_before + v_fine * v_fine) * dt / parts;
  }
  const double work = whole.advance(F0, F1, y, v);
  EXPECT_NEAR(y, y_fine, 1e-12);
  EXPECT_NEAR(v, v_fine, 1e-12);
  EXPECT_NEAR(work - (whole.oscillator().energy(y, v) - start), lost, 1e-6);
  EXPECT_GT(lost, 0.1);
}

// A rigid motion is an oscillator without a spring.
TEST(Oscillator, AFreeMassGetsTheImpulse) {
  const OscillatorStep step({kMass, 0.0, 0.0}, 0.25);
  double y = 1.0, v = 2.0;
  const double work = step.advance(3.0, 5.0, y, v);
  EXPECT_NEAR(v, 2.0 + 0.25 * 4.0 / kMass, 1e-15);
  EXPECT_NEAR(y, 1.0 + 0.25 * 2.0 + 0.25 * 0.25 / kMass * (3.0 / 2.0 + 2.0 / 6.0), 1e-15);
  EXPECT_NEAR(work, 0.5 * kMass * (v * v - 4.0), 1e-14);
}

}  // namespace
