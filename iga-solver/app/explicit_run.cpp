// SPDX-License-Identifier: GPL-2.0-or-later
#include "explicit_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/history.h"
#include "io/state_file.h"
#include "model_report.h"
#include "parallel/all_or_none.h"
#include "parallel/shared_fields.h"
#include "parallel/shared_history.h"
#include "progress.h"
#include "structure/material/viscous.h"
#include "structure/time/stable_time_step.h"

namespace app {

namespace {

using structure::ExplicitSolver;
using structure::step_text;
using Moment = io::SavedState::Moment;

constexpr double kDefaultStepFactor = 0.9;  // of the stable step

std::optional<double> wanted_step(const SolveOptions& options, const io::ModelFile& model) {
  if (options.step) return options.step;
  return model.time ? model.time->step : std::nullopt;
}

long step_count(double span, double longest, const io::ModelFile& model) {
  constexpr double kMaxSteps = 1e15;
  const double steps = std::ceil(span / longest * (1.0 - 1e-12));  // rounding of the quotient adds no step
  if (steps > kMaxSteps)
    throw std::runtime_error(fmt::format("{}: {:.3g} steps of {:.6g} to time {:.6g}, expected at most {:.0e}",
                                         model.file, steps, longest, span, kMaxSteps));
  return std::max(1L, std::lround(steps));
}

/// The model may have changed since: what that means for the state decides.
void compare_settings(const io::SavedState& saved, const io::ModelFile& model) {
  if (saved.settings.empty()) return;  // written before states kept them
  const std::string density = io::difference(saved.settings, model.settings, "density");
  if (!density.empty())
    throw std::runtime_error(fmt::format(
        "{0}: {1} is the state of a solid of another density: {2}; expected that of then, or a new "
        "motion from time 0 by 'state: {1}'",
        model.file, saved.file, density));
  const std::string others = io::difference(saved.settings, model.settings);
  if (!others.empty() && is_first_rank())
    fmt::print(stderr, "WARNING: {}: goes on from {}, saved with another model: {}\n", model.file, saved.file,
               others);
}

/// What a run writes, each when it is due.
class RunOutput {
 public:
  explicit RunOutput(const io::ModelFile& model) : model_(model) {
    if (!model.output) return;
    history_.emplace(MPI_COMM_WORLD, *model.output, model.geometry.units, model.probes,
                     model.named_supports());
    if (model.output->fields) fields_.emplace(MPI_COMM_WORLD, model);
  }
  /// Of a run that goes on from what this one saves.
  void set_next_step(double size) { next_step_ = size; }
  /// Goes on with what an earlier run has written.
  void resume() {
    if (history_) history_->resume();
    if (fields_) fields_->resume();
  }
  void write_if_due(const ExplicitSolver& solver, bool at_end) {
    if (history_) history_->record_if_due(solver);
    if (fields_) fields_->write_if_due(solver);
    if (!model_.time || !model_.time->save) return;
    if (!saves_) saves_.emplace(model_.time->save_every.value_or(HUGE_VAL), solver.time());
    if (saves_->take(solver) || at_end) save(solver);
  }
  void print_paths() const {
    if (history_) print_on_first("  histories    {}\n", history_->path());
    if (fields_) print_on_first("  fields       {}\n", fields_->paths());
    if (saves_) print_on_first("  state        {}\n", *model_.time->save);
  }
  /// For the message of a run that ends early.
  std::string where_histories_are() const {
    return history_ ? "; the histories before it are in " + history_->path() : "";
  }

 private:
  void save(const ExplicitSolver& solver) {
    io::SavedState state = io::moment_of(solver);
    state.moment->step = next_step_;
    state.settings = model_.settings;
    parallel::on_first_rank(MPI_COMM_WORLD,
                            [&] { io::write_state(*model_.time->save, model_.geometry.units, state); });
  }

  const io::ModelFile& model_;
  double next_step_ = 0.0;
  std::optional<parallel::SharedHistory> history_;
  std::optional<parallel::SharedFields> fields_;
  std::optional<io::OutputTimes> saves_;
};

/// Under no forces of others.
void begin(ExplicitSolver& solver, const std::optional<Moment>& continued, const io::ModelFile& model) {
  with_name(model, [&] {
    solver.initialise_forces(structure::NodalVectors::Zero(3, solver.body().node_count()));
    if (continued) solver.load_work_done(continued->work);
  });
}

void make_steps(ExplicitSolver& solver, const Steps& steps, const io::ModelFile& model, Talk talk,
                RunOutput& output) {
  constexpr long kReports = 20;
  const structure::NodalVectors no_forces = structure::NodalVectors::Zero(3, solver.body().node_count());
  output.write_if_due(solver, false);
  Progress progress(steps.count, talk);
  for (long step = 1; step <= steps.count; ++step) {
    try {
      solver.begin_step();
      solver.end_step(no_forces);
    } catch (const structure::Diverged& problem) {
      throw std::runtime_error(
          fmt::format("{}: step {}: {}{}", model.file, step, problem.what(), output.where_histories_are()));
    }
    print_warning(model, solver);
    output.write_if_due(solver, step == steps.count);
    if (talk != Talk::errors_only && is_first_rank()) progress.tell(step, solver.time());
    const bool reports = talk == Talk::more && step < steps.count &&
                         step * kReports / steps.count > (step - 1) * kReports / steps.count;
    if (reports) print_energies(solver);
  }
}

}  // namespace

io::SavedState read_saved(const io::ModelFile& model) {
  if (!model.time || !model.time->save)
    throw std::runtime_error(
        fmt::format("{}: --continue goes on from the file of 'time: {{save: FILE}}', which the model has not",
                    model.file));
  return parallel::on_every_rank(MPI_COMM_WORLD, *model.time->save, [&] {
    return io::read_state(*model.time->save, model.geometry.units, geometry_io::read_file);
  });
}

io::SavedState::Moment go_on(const io::SavedState& saved, const io::ModelFile& model,
                             ExplicitSolver& solver) {
  io::continue_from(saved, solver);
  compare_settings(saved, model);
  return *saved.moment;
}

void print_continued(const io::ModelFile& model, double time) {
  print_on_first("  continues    from time {:.6g} ({})\n", time, *model.time->save);
}

std::optional<double> end_of(const SolveOptions& options, const io::ModelFile& model) {
  if (options.end) return options.end;
  return model.time ? std::optional(model.time->end) : std::nullopt;
}

double longest_step(const SolveOptions& options, const io::ModelFile& model, double stable) {
  const std::optional<double> wanted = wanted_step(options, model);
  if (wanted && *wanted > stable)
    throw std::runtime_error(
        fmt::format("time step {:.6g} is above the stable step {}", *wanted, step_text(stable)));
  if (!wanted && std::isinf(stable))
    throw std::runtime_error("every node is fixed, expected at least one free");
  return wanted.value_or(kDefaultStepFactor * stable);
}

Steps steps_to(double end, const SolveOptions& options, const io::ModelFile& model, double stable,
               const std::optional<Moment>& continued) {
  constexpr double kWhole = 0.01;      // of a step: what round-off may add up to
  constexpr double kRoundOff = 1e-12;  // of a step, by which an end over a number of steps may be longer
  const double begin = continued ? continued->time : 0.0;
  const double longest = with_name(model, [&] { return longest_step(options, model, stable); });
  if (continued) {
    const double rest = (end - begin) / continued->step;
    if (!(rest > kWhole))
      throw std::runtime_error(fmt::format(
          "{}: the saved state is at time {:.6g}, expected a later end than {:.6g}", model.file, begin, end));
    if (std::abs(rest - std::round(rest)) <= kWhole &&
        continued->step <= (wanted_step(options, model) ? (1.0 + kRoundOff) * longest : stable))
      return {std::lround(rest), continued->step, continued->step};
  }
  const long count = step_count(end - begin, longest, model);
  const double size = (end - begin) / static_cast<double>(count);
  return {count, size, count == 1 ? longest : size};
}

double find_stable_step(const io::ModelFile& model, ExplicitSolver& solver, Talk talk) {
  const double undeformed = with_name(model, [&] { return solver.stable_time_step(); }),
               strained = model.state ? with_name(model, [&] { return solver.renew_stable_time_step(); })
                                      : undeformed,
               stable = std::min(undeformed, strained);
  const double viscosity = structure::viscosity(*model.materials.front());
  std::string beside;
  if (stable < undeformed) beside += fmt::format(", strained as in 'state'; {} else", step_text(undeformed));
  if (viscosity > 0.0)
    beside += fmt::format(", damped; {} without", step_text(structure::undamped_step(stable, viscosity)));
  if (talk != Talk::errors_only) print_on_first("  stable step  {}{}\n", step_text(stable), beside);
  return stable;
}

void run_in_time(const SolveOptions& options, io::ModelFile& model) {
  const bool prints = options.talk != Talk::errors_only;
  const std::optional<double> end = end_of(options, model);
  if (!end)
    throw std::runtime_error(
        fmt::format("{}: no end time, expected 'time: {{end: T}}' in it or --end T", model.file));
  std::optional<Moment> continued;
  RunOutput output(model);  // while the control points are there
  std::optional<io::SavedState> saved;
  if (options.continues) saved = read_saved(model);
  ExplicitSolver solver = io::build_solver(model, parallel::cut_among(MPI_COMM_WORLD));
  if (saved) {
    continued = go_on(*saved, model, solver);
    output.resume();
    saved.reset();
  }
  if (prints) print_model(model, solver);
  if (options.talk == Talk::more) print_details(model);
  if (prints && continued) print_continued(model, continued->time);
  const double stable = find_stable_step(model, solver, options.talk);
  const Steps steps = steps_to(*end, options, model, stable, continued);
  with_name(model, [&] {
    solver.expect_finite_conditions(continued ? continued->time : 0.0);
    solver.expect_finite_conditions(*end);
  });
  with_name(model, [&] { solver.set_time_step(steps.size); });
  output.set_next_step(steps.next_size);
  if (prints) print_on_first("  time step    {:.6g}, {} steps\n", steps.size, steps.count);
  begin(solver, continued, model);
  make_steps(solver, steps, model, options.talk, output);
  with_name(model, [&] { solver.look_at_elements(); });
  print_warning(model, solver);
  if (!prints) return;
  print_energies(solver);
  output.print_paths();
}

}  // namespace app
