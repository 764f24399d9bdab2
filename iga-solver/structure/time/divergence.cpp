// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/divergence.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

namespace structure {

namespace {

std::string node_text(const LastStep& step, int node) {
  return fmt::format("control node {}, undeformed at {}", node, text(step.body.reference().col(node)));
}

/// The first node whose value is not finite; -1: none.
int first_not_finite(const NodalVectors& values) {
  for (int A = 0; A < values.cols(); ++A)
    if (!values.col(A).allFinite()) return A;
  return -1;
}

/// What is out of bounds, and at which node.
std::string symptom(const LastStep& step) {
  for (const auto& [values, name] :
       {std::pair{&step.displacements, "displacement"}, std::pair{&step.velocities, "velocity"},
        std::pair{&step.accelerations, "acceleration"}})
    if (const int node = first_not_finite(*values); node >= 0)
      return fmt::format("the {} is not finite at {}", name, node_text(step, node));
  if (step.displacements.cols() == 0) return "in another part of it";
  int node = 0;
  const double largest = step.displacements.colwise().norm().maxCoeff(&node);
  if (largest > kLargestDisplacement)
    return fmt::format("the displacement is {:.3g} at {}", largest, node_text(step, node));
  const Eigen::VectorXd energies =
      step.velocities.colwise().squaredNorm().transpose().cwiseProduct(step.mass.nodal_mass());
  energies.maxCoeff(&node);
  const double kinetic = step.kinetic_energy;
  if (!std::isfinite(kinetic))
    return fmt::format("its kinetic energy is not finite, most at {}", node_text(step, node));
  return fmt::format(
      "its kinetic energy {:.3g} is more than {} times the {:.3g} that it was given, most at {}", kinetic,
      EnergyBudget::kExcess, step.energy_given, node_text(step, node));
}

/// The element that is squeezed most, if it is folded: nothing is said of displacements that are not finite.
std::string folded_element(const LastStep& step) {
  const Body& body = step.body;
  std::vector<double> u(3 * body.padded_functions());
  int folded = -1;
  double lowest = 0.0;
  for (int e = 0; e < body.element_count(); ++e) {
    body.gather(e, step.displacements, u.data());
    const double ratio = body.smallest_volume_ratio(e, u.data());
    if (ratio < lowest) lowest = ratio, folded = e;
  }
  return folded < 0 ? "" : body.describe_element(folded) + " is folded";
}

std::string likely_cause(const LastStep& step) {
  if (const int node = first_not_finite(step.F); node >= 0)
    return fmt::format("the contact force is not finite at {}", node_text(step, node));
  const double dt = step.time_step;
  const std::optional<double>& stable = step.stable_time_step;
  const std::string known = stable ? fmt::format(" (the stable step was {:.6g} at the start)", *stable) : "";
  if (stable && dt > *stable) return fmt::format("the time step {:.6g} is too long{}", dt, known);
  const std::string folded = folded_element(step);
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

std::string describe_divergence(const LastStep& step) {
  return fmt::format("the solid has blown up at time {:.6g}: {}; likely cause: {}", step.time, symptom(step),
                     likely_cause(step));
}

}  // namespace structure
