// SPDX-License-Identifier: GPL-2.0-or-later
#include "analyses.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <string>

#include "explicit_run.h"
#include "io/frequencies.h"
#include "io/history.h"
#include "io/unit_names.h"
#include "model_report.h"
#include "progress.h"
#include "structure/analysis/static_equilibrium.h"

namespace app {

namespace {

using structure::ExplicitSolver;
using structure::NodalVectors;
using Fields = std::optional<io::FieldSeries>;

bool prints(Talk talk) { return talk != Talk::errors_only; }

/// Histories and fields, a row and a state for each result.
class RestOutput {
 public:
  RestOutput(const io::ModelFile& model, Fields& fields) : model_(model), fields_(fields) {
    if (!model.output) return;
    history_.emplace(*model.output, model.geometry.units, model.probes, model.named_supports());
  }
  /// `load_factor`: the part of the constant loads that acts.
  void write(const ExplicitSolver& solver, double load_factor) {
    if (history_) history_->record(row(solver, load_factor));
    if (fields_)
      fields_->write({solver.time(), solver.displacements(), solver.velocities(), solver.memory_in_order()});
  }
  void print_names() const {
    if (history_) fmt::print("  histories    {}\n", history_->path());
    if (!fields_) return;
    for (const std::string& place : model_.output->fields->on)
      fmt::print("  fields       {}_{}.pvd\n", model_.output->file, place);
  }

 private:
  /// An equilibrium has no steps whose work a ledger would have.
  io::HistoryRow row(const ExplicitSolver& solver, double load_factor) const {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    io::HistoryRow row = io::measure(solver, model_.probes, model_.named_supports());
    row.load_work = solver.has_changing_loads() ? kUnknown : load_factor * row.load_work;
    row.work = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
    row.truncation = kUnknown;
    return row;
  }

  const io::ModelFile& model_;
  std::optional<io::History> history_;
  Fields& fields_;
};

void print_result(const io::ModelFile& model, const ExplicitSolver& solver) {
  const std::string work =
      solver.has_changing_loads() ? "not known" : fmt::format("{:.8g}", solver.load_work());
  fmt::print("  strain energy {:.8g}, work of the loads {}, largest displacement {:.8g}\n",
             solver.strain_energy(), work, solver.largest_displacement());
  for (const structure::Probe& probe : model.probes) {
    const structure::Vector3 u = solver.displacement(probe);
    fmt::print("  probe {}: {:.8g} {:.8g} {:.8g}\n", probe.name, u[0], u[1], u[2]);
  }
  for (const structure::NamedSupport& support : model.named_supports()) {
    const structure::Vector3 f = solver.reaction(support);
    fmt::print("  reaction {}: {:.8g} {:.8g} {:.8g}\n", support.name, f[0], f[1], f[2]);
  }
}

void save(const std::optional<std::string>& path, const io::ModelFile& model, const ExplicitSolver& solver,
          Talk talk) {
  if (!path) return;
  io::write_state(*path, model.geometry.units, io::state_of(solver));
  if (prints(talk)) fmt::print("  state        {}\n", *path);
}

/// Whether the laws are for what was found.
void look(const io::ModelFile& model, ExplicitSolver& solver) {
  solver.look_at_elements();
  print_warning(model, solver);
}

constexpr double kFullTime = 1.0;  // loads of that time are the full ones

/// The state under a part of the loads, with their accelerations, which are none, and reactions.
void take(ExplicitSolver& solver, const NodalVectors& u, double load_factor) {
  NodalVectors full, now;
  solver.external_forces(u, kFullTime, full);
  solver.external_forces(u, load_factor, now);
  io::put_at_rest(solver, u, load_factor);
  solver.initialise_forces(load_factor * full - now);
}

void run(const io::StaticAnalysis& analysis, const io::ModelFile& model, Fields& fields,
         ExplicitSolver& solver, Talk talk) {
  RestOutput output(model, fields);
  const auto loads = [&](const NodalVectors& u, NodalVectors& f) { solver.external_forces(u, kFullTime, f); };
  if (prints(talk)) fmt::print("  static       preconditioner ");
  std::fflush(stdout);  // to make one takes minutes of large solids of high degree
  structure::StaticEquilibrium statics(solver.body(), solver.supports(), loads, analysis.options,
                                       solver.springs());
  if (prints(talk)) fmt::print("{}\n", statics.preconditioner());
  const auto tell = [&](const structure::NewtonIteration& done) {
    fmt::print("  load {:.6g}, iteration {}: out of balance {:.2e}, {} products{}\n", done.load_factor,
               done.iteration, done.residual, done.products,
               done.step_length == 1.0 ? "" : fmt::format(", step {:.3g}", done.step_length));
    std::fflush(stdout);
  };
  statics.solve(prints(talk) ? tell : structure::StaticEquilibrium::OnIteration(), [&](double load_factor) {
    take(solver, statics.displacements(), load_factor);
    output.write(solver, load_factor);
  });
  look(model, solver);
  if (prints(talk)) print_result(model, solver);
  save(analysis.save, model, solver, talk);
  if (prints(talk)) output.print_names();
}

void run(const io::RelaxAnalysis& analysis, const io::ModelFile& model, Fields& fields,
         ExplicitSolver& solver, Talk talk) {
  RestOutput output(model, fields);
  if (prints(talk)) fmt::print("  relax        time step {:.6g}\n", solver.time_step());
  long peaks = 0;
  const auto tell = [&](const structure::RelaxPeak& peak) {
    const int peaks_per_line = talk == Talk::more ? 1 : 20;
    if (prints(talk) && ++peaks % peaks_per_line == 0)
      fmt::print("  step {}: out of balance {:.2e}\n", peak.step, peak.residual);
  };
  const structure::RelaxPeak last = structure::relax(solver, analysis.options, tell);
  if (prints(talk)) fmt::print("  at rest after {} steps: out of balance {:.2e}\n", last.step, last.residual);
  output.write(solver, kFullTime);
  look(model, solver);
  if (prints(talk)) print_result(model, solver);
  save(analysis.save, model, solver, talk);
  if (prints(talk)) output.print_names();
}

/// Shapes as states 1, 2, ...: the largest displacement is a hundredth of the body.
void write_shapes(const std::vector<structure::Mode>& modes, Fields& fields, const ExplicitSolver& solver) {
  constexpr double kDrawn = 0.01;
  if (!fields) return;
  const NodalVectors& X = solver.body().reference();
  const double size = (X.rowwise().maxCoeff() - X.rowwise().minCoeff()).maxCoeff();
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const NodalVectors u = (kDrawn * size / modes[k].shape.colwise().norm().maxCoeff()) * modes[k].shape;
    fields->write({k + 1.0, u, NodalVectors::Zero(3, u.cols()), solver.memory_in_order()});
  }
}

void run(const io::ModeAnalysis& analysis, const io::ModelFile& model, Fields& fields, ExplicitSolver& solver,
         Talk talk) {
  structure::ModeOptions options = analysis.options;
  Progress progress(options.count, talk);
  if (prints(talk))
    options.on_solve = [&](int solved, int at_least) { progress.tell_at_least("solve", solved, at_least); };
  const std::vector<structure::Mode> modes = structure::lowest_modes(
      solver.body(), solver.supports(), solver.displacements(), options, solver.springs());
  progress.end();
  if (model.output)
    io::write_frequencies(*model.output, model.geometry.units, modes, solver.mass().nodal_mass());
  write_shapes(modes, fields, solver);
  if (!prints(talk)) return;
  for (std::size_t k = 0; k < modes.size(); ++k)
    fmt::print("  mode {:<4} frequency {:.8g} 1/{}\n", k + 1, modes[k].frequency(),
               io::unit_names(model.geometry.units).time);
  if (!model.output) return;
  fmt::print("  frequencies  {}.h5\n", model.output->file);
  if (model.output->fields)
    for (const std::string& place : model.output->fields->on)
      fmt::print("  shapes       {}_{}.pvd\n", model.output->file, place);
}

}  // namespace

void expect_finite_conditions(const io::ModelFile& model, const ExplicitSolver& solver) {
  if (!std::holds_alternative<io::ModeAnalysis>(*model.analysis)) solver.expect_finite_conditions(kFullTime);
}

void run_analysis(const SolveOptions& options, const io::ModelFile& model, Fields& fields,
                  ExplicitSolver& solver) {
  expect_finite_conditions(model, solver);
  if (std::holds_alternative<io::RelaxAnalysis>(*model.analysis))
    solver.set_time_step(longest_step(options, model, solver.stable_time_step()));
  std::visit([&](const auto& analysis) { run(analysis, model, fields, solver, options.talk); },
             *model.analysis);
}

}  // namespace app
