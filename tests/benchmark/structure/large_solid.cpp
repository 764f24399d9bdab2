// SPDX-License-Identifier: GPL-2.0-or-later
// What a large solid takes: memory, set-up, forces and steps.  One JSON object; times are thread CPU time.
//   large_solid METHOD BODY N DEGREE [--stable]        N x N x N elements; --stable: the stable step, too
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "bodies.h"
#include "cpu_seconds.h"
#include "volumes.h"

namespace benchmarks {
namespace {

using nurbs::NodalVectors;

/// What the process has asked for and not given back [byte].
double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

double peak_bytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Seconds of a force and of a step that follow one another, so that all that disturbs hits both.
struct Times {
  double force, step;
};
Times time_steps(structure::ExplicitSolver& solver) {
  constexpr int kRepetitions = 5;
  NodalVectors f = NodalVectors::Zero(3, solver.body().node_count());
  const NodalVectors none = f;
  std::vector<double> force, step;
  for (int i = 0; i < kRepetitions; ++i) {
    force.push_back(cpu_seconds([&] { solver.body().internal_force(solver.displacements(), f); }));
    step.push_back(cpu_seconds([&] { solver.begin_step(), solver.end_step(none); }));
  }
  return {median(force), median(step)};
}

void measure(const std::string& method, const std::string& body, int n, int degree, bool stable) {
  const nurbs::Volume volume = make_volume(body, {n, n, n}, degree);
  const double dofs = 3.0 * volume.space.control_point_count(), before = allocated();
  std::unique_ptr<structure::Solid> solid;
  const double set_up =
      cpu_seconds([&] { solid = make_solid(method_named(method), volume, "linear_elastic"); });
  const double of_solid = allocated() - before;
  std::unique_ptr<structure::ExplicitSolver> solver;
  const double begin = cpu_seconds([&] { solver = ringing(std::move(solid), n); });
  const double of_solver = allocated() - before - of_solid;
  const double stable_step = stable ? cpu_seconds([&] { solver->stable_time_step(); }) : 0.0;
  const Times times = time_steps(*solver);
  fmt::print(R"({{"method": "{}", "body": "{}", "elements": {}, "degree": {}, "dofs": {},)", method, body,
             volume.space.element_count(), degree, dofs);
  fmt::print(R"( "solid_bytes": {}, "solver_bytes": {}, "peak_bytes": {},)", of_solid, of_solver,
             peak_bytes());
  fmt::print(
      R"( "set_up": {:.4g}, "first_forces": {:.4g}, "stable_step": {}, "force": {:.4g}, "step": {:.4g}}})",
      set_up, begin, stable ? fmt::format("{:.4g}", stable_step) : "null", times.force, times.step);
  fmt::print("\n");
}

}  // namespace
}  // namespace benchmarks

int main(int argc, char** argv) try {
  const bool stable = argc == 6 && std::strcmp(argv[5], "--stable") == 0;
  if (argc != 5 && !stable) {
    std::fputs("usage: large_solid METHOD BODY N DEGREE [--stable]\n", stderr);
    return 2;
  }
  benchmarks::measure(argv[1], argv[2], std::atoi(argv[3]), std::atoi(argv[4]), stable);
} catch (const std::exception& problem) {
  std::fprintf(stderr, "large_solid: %s\n", problem.what());
  return 1;
}
