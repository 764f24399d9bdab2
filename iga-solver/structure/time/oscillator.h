// SPDX-License-Identifier: GPL-2.0-or-later
// One degree of freedom, m y'' + d y' + k y = F(t), over time steps in which F is linear: exact, whatever the
// damping and however long the step, by the exponential of the matrix of (y, v, F, dF/dt, integral of y).
// Source: Van Loan (1978), IEEE Trans. Autom. Control 23, 395-404; Craig & Kurdila (2006), sec. 6.1.
#pragma once

#include <Eigen/Core>

namespace structure {

/// Generalised: coordinates that have mass 1 and no unit of length will do.
struct Oscillator {
  double mass, damping, stiffness;  ///< > 0, >= 0, >= 0

  double energy(double y, double v) const { return 0.5 * (mass * v * v + stiffness * y * y); }
};

class OscillatorStep {
 public:
  /// `dt` [time] > 0.
  OscillatorStep(const Oscillator& oscillator, double dt);

  const Oscillator& oscillator() const { return oscillator_; }
  /// y and v go to the end of the step, over which the force goes from F0 to F1.  The work that it does
  /// [energy]: less the change of energy it is what damping has taken.
  double advance(double F0, double F1, double& y, double& v) const;

 private:
  Oscillator oscillator_;
  Eigen::Matrix<double, 3, 4> map_;  // (y, v, F0, F1 - F0) to (y, v, mean of y)
};

}  // namespace structure
