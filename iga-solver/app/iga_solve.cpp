// SPDX-License-Identifier: GPL-2.0-or-later
// iga-solve: runs the model file of a solid without particles, on one rank or several.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "analyses.h"
#include "command.h"
#include "io/model_file.h"
#include "parallel/all_or_none.h"
#include "parallel/session.h"
#include "parallel/shared_fields.h"
#include "parallel/shared_history.h"
#include "structure/material/viscous.h"
#include "structure/time/stable_time_step.h"

namespace {

using structure::ExplicitSolver;

struct Options {
  std::string model;
  std::optional<double> end, step;
  bool quiet = false;
};

constexpr double kDefaultStepFactor = 0.9;  // of the stable step

double end_time(const Options& options, const io::ModelFile& model) {
  if (options.end) return *options.end;
  if (model.time) return model.time->end;
  throw std::runtime_error(
      fmt::format("{}: no end time, expected 'time: {{end: T}}' in it or --end T", model.file));
}

// What action() returns; an error names the file.
template <class Action>
auto with_name(const io::ModelFile& model, Action action) try {
  return action();
} catch (const std::bad_alloc&) {
  throw;  // run_command names it
} catch (const std::exception& problem) {
  throw std::runtime_error(fmt::format("{}: {}", model.file, problem.what()));
}

double time_step(const Options& options, const io::ModelFile& model, double stable) {
  std::optional<double> wanted = options.step;
  if (!wanted && model.time) wanted = model.time->step;
  if (wanted && *wanted > stable)
    throw std::runtime_error(
        fmt::format("{}: time step {:.6g} is above the stable step {:.6g}", model.file, *wanted, stable));
  if (!wanted && std::isinf(stable))
    throw std::runtime_error(fmt::format("{}: every node is fixed, expected at least one free", model.file));
  return wanted.value_or(kDefaultStepFactor * stable);
}

long step_count(double end, double largest_step) {
  constexpr double kMaxSteps = 1e15;
  const double steps =
      std::ceil(end / largest_step * (1.0 - 1e-12));  // rounding of the quotient adds no step
  if (steps > kMaxSteps)
    throw std::runtime_error(fmt::format("{:.3g} steps of {:.6g} to time {:.6g}, expected at most {:.0e}",
                                         steps, largest_step, end, kMaxSteps));
  return std::max(1L, std::lround(steps));
}

// Rank 0 prints; what is asked of all nodes is asked by all.
bool is_first_rank() { return parallel::Ranks(MPI_COMM_WORLD).me == 0; }

template <class... Values>
void print_on_first(const char* format, const Values&... values) {
  if (is_first_rank()) fmt::print(fmt::runtime(format), values...);
}

void print_model(const io::ModelFile& model, const ExplicitSolver& solver) {
  const structure::Halo& halo = solver.halo();
  const Eigen::Index owned = halo.owned(solver.body().node_count());
  const std::vector<Eigen::Index>& fixed = solver.supports().fixed_dofs();
  const double fixed_dofs = halo.sum(double(std::count_if(
                   fixed.begin(), fixed.end(), [&](Eigen::Index dof) { return dof < 3 * owned; }))),
               mass = halo.sum(solver.mass().nodal_mass().head(owned).sum());

  print_on_first("{} (units {})\n", model.file, geometry_io::units_name(model.geometry.units));
  for (int p = 0; p < model.patch_count(); ++p) {
    const nurbs::Space<3>& space = model.volume(p).space;
    print_on_first("  elements     {} ({} x {} x {}), degrees {} {} {}{}\n", space.element_count(),
                   space.knots(0).element_count(), space.knots(1).element_count(),
                   space.knots(2).element_count(), space.degree(0), space.degree(1), space.degree(2),
                   model.patch_count() > 1 ? fmt::format(" of patch {}", p) : "");
  }
  if (model.patch_count() > 1)
    print_on_first("  welds        {} nodes of several patches\n", model.nodes.welded().size());
  print_on_first("  dof          {}, {} of them fixed\n", 3L * model.nodes.node_count(),
                 static_cast<long>(fixed_dofs));
  print_on_first("  mass         {:.8g}\n", mass);
}

void print_progress(long step, long steps, double time) {
  if (!is_first_rank()) return;
  fmt::print("\r  step {} of {}, time {:.6g}", step, steps, time);
  if (step == steps) fmt::print("\n");
  std::fflush(stdout);
}

void print_energies(const ExplicitSolver& solver) {
  const structure::Work ledger = solver.work();
  const double kinetic = solver.kinetic_energy(), strain = solver.strain_energy(), work = solver.load_work(),
               supports = ledger.supports, damped = ledger.damped;
  const auto column = [](const char* name, double energy) {
    return energy == 0.0 ? "" : fmt::format(", {} {:.8g}", name, energy);
  };
  print_on_first(
      "  energies at time {:.6g}: kinetic {:.8g}, strain {:.8g}, work of the loads {:.8g}{}{}, balance "
      "{:.8g}\n",
      solver.time(), kinetic, strain, work, column("of the supports", supports), column("damped", damped),
      kinetic + strain + damped - work - supports);
}

// One step; of a solid that blows up, names the file and what is left of the run.
void advance(ExplicitSolver& solver, const structure::NodalVectors& no_forces, long step,
             const io::ModelFile& model, const std::optional<parallel::SharedHistory>& history) {
  try {
    solver.begin_step();
    solver.end_step(no_forces);
  } catch (const structure::Diverged& problem) {
    throw std::runtime_error(
        fmt::format("{}: step {}: {}{}", model.file, step, problem.what(),
                    history ? "; the histories before it are in " + history->path() : ""));
  }
}

io::ModelFile read(const Options& options) {
  return parallel::on_every_rank(MPI_COMM_WORLD, options.model,
                                 [&] { return io::read_model_file(options.model); });
}

void analyse(io::ModelFile& model, bool quiet) {
  if (parallel::Ranks(MPI_COMM_WORLD).count > 1)
    throw std::runtime_error(
        fmt::format("{}: an 'analysis' runs on one rank, expected iga-solve without mpiexec", model.file));
  std::optional<io::FieldSeries> fields;  // while the control points are there
  if (model.output && model.output->fields) fields.emplace(model);
  ExplicitSolver solver = io::build_solver(model);
  if (!quiet) print_model(model, solver);
  with_name(model, [&] { app::run_analysis(model, fields, solver, quiet); });
}

void run(const Options& options) {
  io::ModelFile model = read(options);
  if (model.loads.gravity && model.loads.gravity->of_the_deck)
    throw std::runtime_error(
        fmt::format("{}: loads.gravity is deck, expected a vector: there is no deck here", model.file));
  if (model.analysis) return analyse(model, options.quiet);
  const double end = end_time(options, model);
  std::optional<parallel::SharedFields> fields;
  if (model.output && model.output->fields) fields.emplace(MPI_COMM_WORLD, model);
  ExplicitSolver solver = io::build_solver(model, parallel::cut_among(MPI_COMM_WORLD));
  if (!options.quiet) print_model(model, solver);
  const double stable = with_name(model, [&] { return solver.stable_time_step(); });
  const double viscosity = structure::viscosity(*model.materials.front());
  if (!options.quiet)
    print_on_first("  stable step  {:.6g}{}\n", stable,
                   viscosity == 0.0 ? ""
                                    : fmt::format(", damped; {:.6g} without",
                                                  structure::undamped_step(stable, viscosity)));
  const double largest_step = time_step(options, model, stable);
  const long steps = with_name(model, [&] { return step_count(end, largest_step); });
  solver.set_time_step(end / steps);  // never longer than asked for, and the last step ends at `end`
  if (!options.quiet) print_on_first("  time step    {:.6g}, {} steps\n", solver.time_step(), steps);

  const structure::NodalVectors no_forces = structure::NodalVectors::Zero(3, solver.body().node_count());
  with_name(model, [&] { solver.initialise_forces(no_forces); });
  std::optional<parallel::SharedHistory> history;
  if (model.output)
    history.emplace(MPI_COMM_WORLD, *model.output, model.geometry.units, model.probes,
                    model.named_supports());
  if (history) history->record_if_due(solver);
  if (fields) fields->write_if_due(solver);
  const bool progress = !options.quiet && isatty(STDOUT_FILENO);
  for (long step = 1; step <= steps; ++step) {
    advance(solver, no_forces, step, model, history);
    if (history) history->record_if_due(solver);
    if (fields) fields->write_if_due(solver);
    if (progress && (step % std::max(1L, steps / 100) == 0 || step == steps))
      print_progress(step, steps, solver.time());
  }
  if (!options.quiet) {
    print_energies(solver);
    if (history) print_on_first("  histories    {}\n", history->path());
    if (fields) print_on_first("  fields       {}\n", fields->paths());
  }
}

// An error is the same on all ranks, and one tells it; but for memory, of which one may have less.
void run_on_ranks(const Options& options) {
  const parallel::Ranks ranks(MPI_COMM_WORLD);
  try {
    run(options);
  } catch (const std::bad_alloc&) {
    if (ranks.count == 1) throw;
    app::print_error(nurbs::out_of_memory(options.model));
    MPI_Abort(MPI_COMM_WORLD, 1);
  } catch (const std::exception&) {
    if (ranks.me == 0) throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const parallel::Session session(&argc, &argv);
  Options options;
  CLI::App command("Runs the model file of a NURBS solid without particles: explicit, isogeometric.");
  command.add_option("model", options.model, "model file (YAML)")->required();
  command.add_option("--end", options.end, "end time, in the model's units (else time: {end} of the model)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--step", options.step,
                  "largest time step (else time: {step}, else 0.9 of the stable step)")
      ->check(CLI::PositiveNumber);
  command.add_flag("--quiet", options.quiet, "print nothing but errors");
  return app::run_command(command, argc, argv, options.model, [&] { run_on_ranks(options); });
}
