// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "structure/analysis/held.h"

namespace structure {

namespace {

double relative_residual(const ExplicitSolver& solver, double conditions_time, NodalVectors& f) {
  NodalVectors loads;
  solver.external_forces(solver.displacements(), conditions_time, loads);
  solver.internal_forces(solver.displacements(), f);
  const double size = std::max({loads.norm(), f.norm(), std::numeric_limits<double>::min()});
  f = loads - f;
  solver.supports().apply(f);
  return f.norm() / size;
}

/// By row sums of the mass, whatever the mass: what counts is where it has a peak.
double kinetic_energy(const ExplicitSolver& solver) {
  const NodalVectors& v = solver.velocities();
  return 0.5 * solver.halo().sum_over_nodes(v.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto squares = v.middleCols(first, count).colwise().squaredNorm().transpose();
    return squares.cwiseProduct(solver.mass().nodal_mass().segment(first, count)).sum();
  });
}

}  // namespace

RelaxPeak relax(ExplicitSolver& solver, const RelaxOptions& options,
                const std::function<void(const RelaxPeak&)>& on_peak) {
  expect_held("relax", solver.body(), solver.supports(), solver.springs());
  const NodalVectors none = NodalVectors::Zero(3, solver.body().node_count());
  NodalVectors f = none;
  NodalVectors at_peak = none;  // displacements
  double kinetic = 0.0;
  const double share = solver.time_step() / solver.stable_time_step();
  solver.go_on_when_strained();
  solver.hold_conditions_at(options.conditions_time);
  solver.set_velocities(none);
  solver.initialise_forces(none);  // which puts supports where they are to be
  RelaxPeak peak{0, relative_residual(solver, options.conditions_time, f)};
  for (long step = 1; peak.residual > options.tolerance; ++step) {
    if (step > options.most_steps)
      throw std::runtime_error(
          fmt::format("relax: forces out of balance are {:.3g} of loads and reactions after {} steps, "
                      "expected {:.1e}: try more 'steps', or 'analysis: static'",
                      peak.residual, options.most_steps, options.tolerance));
    solver.begin_step();
    solver.end_step(none);
    if (solver.is_too_strained()) solver.set_time_step(share * solver.stable_time_step_now());
    const double now = kinetic_energy(solver);
    if (now >= kinetic) {
      kinetic = now;
      at_peak = solver.displacements();
      continue;
    }
    solver.set_motion(at_peak, none, solver.time());
    solver.settle();
    solver.initialise_forces(none);
    peak = {step, relative_residual(solver, options.conditions_time, f)};
    if (on_peak) on_peak(peak);
    kinetic = 0.0;
  }
  return peak;
}

}  // namespace structure
