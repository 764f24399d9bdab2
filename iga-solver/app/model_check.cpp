// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_check.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "analyses.h"
#include "explicit_run.h"
#include "geometry_io/regular_file.h"
#include "io/history.h"
#include "io/loose_patches.h"
#include "model_report.h"
#include "nurbs/memory.h"
#include "parallel/all_or_none.h"
#include "progress.h"

namespace app {

namespace {

using structure::ExplicitSolver;
using Clock = std::chrono::steady_clock;
using Continued = std::optional<io::SavedState::Moment>;

/// The most that this process has had [bytes].
double memory_taken() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void print_size(const io::ModelFile& model, const ExplicitSolver& solver) {
  long control_points = 0;
  for (int p = 0; p < model.patch_count(); ++p) control_points += model.volume(p).space.control_point_count();
  const int pieces = io::pieces_of(model.nodes).count;
  print_on_first("  patches      {}, {} control points, {} nodes{}\n", model.patch_count(), control_points,
                 static_cast<long>(model.nodes.node_count()),
                 pieces > 1 ? fmt::format(", {} pieces that are not welded to each other", pieces) : "");
  print_on_first("  memory       {} so far{}\n", nurbs::size_text(solver.halo().sum(memory_taken())),
                 model.analysis ? "; an analysis takes more" : "");
}

/// Times that are multiples of `every` from 0 to `end`.
long times_until(double end, double every) {
  return 1 + static_cast<long>(std::floor(end / every * (1 + 1e-12)));
}

/// What is written at the start of a run that goes on, and before, is there.
void print_output(const io::ModelFile& model, double end, const Steps& steps, const Continued& continued) {
  if (!model.output) return print_on_first("  output       none\n");
  const auto count = [&](double every) {
    return continued ? std::min(steps.count, times_until(end, every) - times_until(continued->time, every))
                     : std::min(steps.count + 1, times_until(end, every));
  };
  print_on_first("  output       {} {}rows of histories", count(model.output->every),
                 continued ? "more " : "");
  if (const auto& fields = model.output->fields)
    print_on_first(", {} states of fields at {} places",
                   count(fields->every ? *fields->every : *fields->steps * steps.size), fields->on.size());
  print_on_first("\n");
}

/// The stable step has just been found by 20 internal forces in `seconds`; a step is little more than one.
void print_duration(const Steps& steps, double seconds) {
  constexpr double kForces = 20.0, kStepPerForce = 1.1;
  const double run = kStepPerForce * seconds / kForces * static_cast<double>(steps.count);
  print_on_first("  run time     {}{}, without output\n", run < 1.0 ? "" : "about ", duration_text(run));
}

void expect_place_for(const std::string& path) {
  parallel::on_first_rank(MPI_COMM_WORLD, [&] {
    const std::string problem = geometry_io::problem_as_later_output(path);
    if (!problem.empty()) throw std::runtime_error(fmt::format("{}: cannot write here: {}", path, problem));
  });
}

std::optional<std::string> save_of(const io::ModelFile& model) {
  if (!model.analysis) return model.time ? model.time->save : std::nullopt;
  if (const auto* statics = std::get_if<io::StaticAnalysis>(&*model.analysis)) return statics->save;
  if (const auto* relax = std::get_if<io::RelaxAnalysis>(&*model.analysis)) return relax->save;
  return {};
}

void check_motion(const SolveOptions& options, const io::ModelFile& model, ExplicitSolver& solver,
                  const Continued& continued) {
  const Clock::time_point start = Clock::now();
  with_name(model, [&] { solver.stable_time_step(); });  // kept
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const double stable = find_stable_step(model, solver, Talk::usual);
  const std::optional<double> end = end_of(options, model);
  with_name(model, [&] {
    solver.expect_finite_conditions(continued ? continued->time : 0.0);
    if (end) solver.expect_finite_conditions(*end);
  });
  if (!end)
    return print_on_first("  time step    not known: neither 'time: {{end: T}}' nor --end T is given\n");
  const Steps steps = steps_to(*end, options, model, stable, continued);
  with_name(model, [&] { solver.set_time_step(steps.size); });
  print_on_first("  time step    {:.6g}, {} steps\n", steps.size, steps.count);
  print_duration(steps, seconds);
  print_output(model, *end, steps, continued);
}

}  // namespace

void check_save(const io::ModelFile& model) {
  if (const std::optional<std::string> path = save_of(model)) expect_place_for(*path);
}

void check_model(const SolveOptions& options, io::ModelFile& model) {
  if (model.output) expect_place_for(io::checked_path(*model.output));
  check_save(model);
  const std::vector<std::string> warnings =
      warnings_of(model, model.analysis ? std::nullopt : end_of(options, model));
  std::optional<io::SavedState> saved;
  if (options.continues) saved = read_saved(model);
  ExplicitSolver solver = io::build_solver(model, parallel::cut_among(MPI_COMM_WORLD));
  Continued continued;
  if (saved) continued = go_on(*saved, model, solver);
  saved.reset();
  print_model(model, solver);
  print_details(model);
  print_size(model, solver);
  if (continued) print_continued(model, continued->time);
  if (model.analysis) {
    with_name(model, [&] { expect_finite_conditions(model, solver); });
    print_on_first("  analysis     {}\n", io::analysis_word(*model.analysis));
  } else
    check_motion(options, model, solver, continued);
  for (const std::string& warning : warnings) print_on_first("WARNING: {}: {}\n", model.file, warning);
}

}  // namespace app
