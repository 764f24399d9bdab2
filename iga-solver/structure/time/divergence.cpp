// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/time/divergence.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "structure/time/stable_time_step.h"

namespace structure {

namespace {

/// A node that the part owns, by its column, and how bad it is; kNowhere if it has none.
struct Worst {
  double value = kNowhere;
  Eigen::Index column = 0;
};

/// "WORDS at control node 7, undeformed at (1, 2, 3)": what the worst of all parts says.
std::string at_worst(const LastStep& step, const Worst& worst, const std::string& words) {
  const Id id = worst.value > kNowhere ? step.halo.node_id(worst.column) : -1;
  return step.halo.words_of_largest(worst.value, id, [&] {
    return fmt::format("{} at control node {}, undeformed at {}", words, id,
                       text(step.body.reference().col(worst.column)));
  });
}

/// Of the part's own nodes the one with the largest value, the first if several have it.
template <class Values>
Worst largest_of(const Values& values) {
  Worst worst;
  if (values.size() > 0) worst.value = values.maxCoeff(&worst.column);
  return worst;
}

/// The first node whose value is not finite.
Worst not_finite(const LastStep& step, const NodalVectors& values) {
  const auto own = step.halo.own(values);
  for (Eigen::Index A = 0; A < own.cols(); ++A)
    if (!own.col(A).allFinite()) return {1.0, A};
  return {};
}

/// What is out of bounds, and at which node.
std::string symptom(const LastStep& step) {
  for (const auto& [values, name] :
       {std::pair{&step.displacements, "displacement"}, std::pair{&step.velocities, "velocity"},
        std::pair{&step.accelerations, "acceleration"}})
    if (const Worst worst = not_finite(step, *values); step.halo.any(worst.value > kNowhere))
      return at_worst(step, worst, fmt::format("the {} is not finite", name));
  const Eigen::VectorXd lengths = step.halo.own(step.displacements).colwise().norm();
  const Worst longest = largest_of(lengths);
  if (step.halo.any(longest.value > kLargestDisplacement))
    return at_worst(step, longest, fmt::format("the displacement is {:.3g}", longest.value));
  const auto v = step.halo.own(step.velocities);
  const Eigen::VectorXd energies =
      v.colwise().squaredNorm().transpose().cwiseProduct(step.mass.nodal_mass().head(v.cols()));
  const double kinetic = step.kinetic_energy;
  return at_worst(step, largest_of(energies),
                  std::isfinite(kinetic)
                      ? fmt::format("its kinetic energy {:.3g} is more than {} times the {:.3g} that it was "
                                    "given, most",
                                    kinetic, EnergyBudget::kExcess, step.energy_given)
                      : "its kinetic energy is not finite, most");
}

/// The element that is squeezed most, if it is folded: nothing is said of displacements that are not finite.
std::string folded_element(const LastStep& step) {
  const Body& body = step.body;
  std::vector<double> u;
  int folded = -1;
  double lowest = 0.0;
  for (int e = 0; e < body.element_count(); ++e) {
    u.resize(3 * static_cast<std::size_t>(body.padded_functions(e)));
    body.gather(e, step.displacements, u.data());
    const double ratio = body.smallest_volume_ratio(e, u.data());
    if (ratio < lowest) lowest = ratio, folded = e;
  }
  const Id id = folded < 0 ? -1 : step.halo.element_id(folded);
  return step.halo.words_of_largest(folded < 0 ? kNowhere : -lowest, id, [&] {
    return fmt::format("element {} ({}) is folded", id, body.describe_element(folded));
  });
}

std::string likely_cause(const LastStep& step) {
  if (const Worst worst = not_finite(step, step.F); step.halo.any(worst.value > kNowhere))
    return at_worst(step, worst, "the contact force is not finite");
  const double dt = step.time_step;
  const std::optional<double>& stable = step.stable_time_step;
  const std::string known =
      stable ? fmt::format(" (the stable step was {} at the start)", step_text(*stable)) : "";
  if (stable && dt > *stable) return fmt::format("the time step {:.6g} is too long{}", dt, known);
  const auto or_step = [&](const char* words) {  // of a solid that has taken one
    return dt > 0.0 ? fmt::format(fmt::runtime(words), dt) + known : "";
  };
  const std::string folded = folded_element(step);
  if (!folded.empty())
    return fmt::format("{}: the loads, contact forces or initial velocities are too large for it{}", folded,
                       or_step(", or the time step {:.6g} is too long for what it is strained to"));
  return fmt::format("too large loads, contact forces or initial velocities{}",
                     or_step(", or too long a time step, {:.6g}"));
}

}  // namespace

std::string describe_divergence(const LastStep& step) {
  return fmt::format("the solid has blown up at time {:.6g}: {}; likely cause: {}", step.time, symptom(step),
                     likely_cause(step));
}

}  // namespace structure
