// SPDX-License-Identifier: GPL-2.0-or-later
// A run that blows up: how every step notices it, and what is said of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "nurbs/usable_number.h"
#include "structure/body.h"
#include "structure/halo.h"
#include "structure/time/mass.h"

namespace structure {

using nurbs::NodalVectors;

/// Displacements beyond it mean nothing, and their squares overflow [length].
constexpr double kLargestDisplacement = nurbs::kLargestNumber;

/// A solid has blown up; what() says in one line when, where and why, as far as that can be told.
struct Diverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The stable step has come down to the time step.
struct TooStrained : Diverged {
  using Diverged::Diverged;
};

/// The energy that a solid has been given.  Below the stable step a linear solid's kinetic energy never
/// exceeds
///   K(0) + S(0) + dt^2/8 a(0) . M a(0) + sum of dt/2 (P(n-1) + P(n)),
/// P = F . v being the power of all forces that are not its own (sum the scheme over the steps, mode by mode:
/// what is missing is a sum of squares).  A solid that has many times the most it was ever given is unstable.
class EnergyBudget {
 public:
  /// `negligible`: an energy that round-off may give.
  EnergyBudget(double energy, double negligible) : given_(energy), most_(std::max(energy, negligible)) {}

  void add(double work) {
    given_ += work;
    most_ = std::max(most_, given_);
  }
  double most() const { return most_; }
  /// False also for what is not finite.
  bool allows(double kinetic_energy) const {
    return std::isfinite(kinetic_energy) && kinetic_energy <= kExcess * most_;
  }

  static constexpr double kExcess = 10.0;

 private:
  double given_, most_;
};

/// The end of a body's last step, or of a part's; arrays are 3 x node_count, as in ExplicitSolver.
struct LastStep {
  const Body& body;
  const Halo& halo;
  const MassOperator& mass;
  const NodalVectors &displacements, &velocities, &accelerations;
  const NodalVectors& F;  ///< forces of others [force]
  double time, time_step;
  std::optional<double> stable_time_step;  ///< if it is known
  double kinetic_energy, energy_given;
};

/// What is wrong with a body that has blown up: time, control node, and the likely cause among the forces F,
/// a time step above the stable one, and folded elements.  Collective: the worst of all parts, in the same
/// words on each.
std::string describe_divergence(const LastStep& step);

}  // namespace structure
