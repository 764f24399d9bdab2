// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/oscillator.h"

#include <unsupported/Eigen/MatrixFunctions>

namespace structure {

namespace {

/// Of d/dtau (y, v dt, F, F', integral of y), tau the time over dt.
Eigen::Matrix<double, 5, 5> rates(const Oscillator& o, double dt) {
  enum { kY, kV, kForce, kSlope, kIntegral };
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  A(kY, kV) = 1.0;
  A(kV, kY) = -o.stiffness / o.mass * dt * dt;
  A(kV, kV) = -o.damping / o.mass * dt;
  A(kV, kForce) = dt * dt / o.mass;
  A(kForce, kSlope) = 1.0;
  A(kIntegral, kY) = 1.0;
  return A;
}

}  // namespace

OscillatorStep::OscillatorStep(const Oscillator& oscillator, double dt) : oscillator_(oscillator) {
  const Eigen::Matrix<double, 5, 5> step = rates(oscillator, dt).exp();
  map_.row(0) = step.row(0).head<4>();
  map_.row(1) = step.row(1).head<4>() / dt;
  map_.row(2) = step.row(4).head<4>();
  map_.col(1) *= dt;
}

double OscillatorStep::advance(double F0, double F1, double& y, double& v) const {
  const Eigen::Vector3d next = map_ * Eigen::Vector4d(y, v, F0, F1 - F0);
  const double work = F1 * next[0] - F0 * y - (F1 - F0) * next[2];  // by parts
  y = next[0];
  v = next[1];
  return work;
}

}  // namespace structure
