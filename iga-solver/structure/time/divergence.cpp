// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/divergence.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "structure/time/explicit_solver.h"
#include "structure/time/stable_time_step.h"

namespace structure {

namespace {

std::string node_text(const ExplicitSolver& solver, int node) {
  return fmt::format("control node {}, undeformed at {}", node, text(solver.body().reference().col(node)));
}

/// The first node whose value is not finite; -1: none.
int first_not_finite(const NodalVectors& values) {
  for (int A = 0; A < values.cols(); ++A)
    if (!values.col(A).allFinite()) return A;
  return -1;
}

/// What is out of bounds, and at which node.
std::string symptom(const ExplicitSolver& solver, double energy_given) {
  for (const auto& [values, name] :
       {std::pair{&solver.displacements(), "displacement"}, std::pair{&solver.velocities(), "velocity"},
        std::pair{&solver.accelerations(), "acceleration"}})
    if (const int node = first_not_finite(*values); node >= 0)
      return fmt::format("the {} is not finite at {}", name, node_text(solver, node));
  int node = 0;
  const double largest = solver.displacements().colwise().norm().maxCoeff(&node);
  if (largest > kLargestDisplacement)
    return fmt::format("the displacement is {:.3g} at {}", largest, node_text(solver, node));
  const Eigen::VectorXd energies =
      solver.velocities().colwise().squaredNorm().transpose().cwiseProduct(solver.mass().nodal_mass());
  energies.maxCoeff(&node);
  const double kinetic = solver.kinetic_energy();
  if (!std::isfinite(kinetic))
    return fmt::format("its kinetic energy is not finite, most at {}", node_text(solver, node));
  return fmt::format(
      "its kinetic energy {:.3g} is more than {} times the {:.3g} that it was given, most at {}", kinetic,
      EnergyBudget::kExcess, energy_given, node_text(solver, node));
}

/// The element that is squeezed most, if it is folded: nothing is said of displacements that are not finite.
std::string folded_element(const ExplicitSolver& solver) {
  const Body& body = solver.body();
  std::vector<double> u(3 * body.padded_functions());
  int folded = -1;
  double lowest = 0.0;
  for (int e = 0; e < body.element_count(); ++e) {
    body.gather(e, solver.displacements(), u.data());
    const double ratio = body.smallest_volume_ratio(e, u.data());
    if (ratio < lowest) lowest = ratio, folded = e;
  }
  return folded < 0 ? "" : body.describe_element(folded) + " is folded";
}

std::string likely_cause(const ExplicitSolver& solver, const NodalVectors& F,
                         const std::optional<double>& stable) {
  if (const int node = first_not_finite(F); node >= 0)
    return fmt::format("the contact force is not finite at {}", node_text(solver, node));
  const double dt = solver.time_step();
  const std::string known = stable ? fmt::format(" (the stable step was {:.6g} at the start)", *stable) : "";
  if (stable && dt > kStableStepSafety * *stable)
    return fmt::format("the time step {:.6g} is too long{}", dt, known);
  const std::string folded = folded_element(solver);
  if (!folded.empty())
    return fmt::format(
        "{}: the loads, contact forces or initial velocities are too large for it, or the time step {:.6g} "
        "is too "
        "long for what it is strained to{}",
        folded, dt, known);
  return fmt::format(
      "too large loads, contact forces or initial velocities, or too long a time step, {:.6g}{}", dt, known);
}

}  // namespace

std::string describe_divergence(const ExplicitSolver& solver, const NodalVectors& F,
                                const std::optional<double>& stable_time_step, double energy_given) {
  return fmt::format("the solid has blown up at time {:.6g}: {}; likely cause: {}", solver.time(),
                     symptom(solver, energy_given), likely_cause(solver, F, stable_time_step));
}

}  // namespace structure
