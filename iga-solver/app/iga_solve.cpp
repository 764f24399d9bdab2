// SPDX-License-Identifier: GPL-2.0-or-later
// iga-solve: runs the model file of a solid without particles, on one rank or several.
#include <fmt/format.h>

#include <new>
#include <stdexcept>

#include "analyses.h"
#include "command.h"
#include "explicit_run.h"
#include "held_pieces.h"
#include "io/model_file.h"
#include "model_check.h"
#include "model_report.h"
#include "parallel/all_or_none.h"
#include "parallel/session.h"
#include "solve_options.h"

namespace {

using app::SolveOptions;
using app::Talk;

io::ModelFile read(const SolveOptions& options) {
  return parallel::on_every_rank(MPI_COMM_WORLD, options.model,
                                 [&] { return io::read_model_file(options.model); });
}

void analyse(const SolveOptions& options, io::ModelFile& model) {
  if (parallel::Ranks(MPI_COMM_WORLD).count > 1)
    throw std::runtime_error(
        fmt::format("{}: an 'analysis' runs on one rank, expected iga-solve without mpiexec", model.file));
  app::expect_held_pieces(model);
  std::optional<io::FieldSeries> fields;  // while the control points are there
  if (model.output && model.output->fields) fields.emplace(model);
  structure::ExplicitSolver solver = io::build_solver(model);
  if (options.talk != Talk::errors_only) app::print_model(model, solver);
  if (options.talk == Talk::more) app::print_details(model);
  app::with_name(model, [&] { app::run_analysis(options, model, fields, solver); });
}

void run(const SolveOptions& options) {
  io::ModelFile model = read(options);
  if (model.loads.gravity && model.loads.gravity->of_the_deck)
    throw std::runtime_error(
        fmt::format("{}: loads.gravity is deck, expected a vector: there is no deck here", model.file));
  if (options.continues && model.analysis)
    throw std::runtime_error(
        fmt::format("{}: --continue goes on with a motion in time, the model has an 'analysis'", model.file));
  if (options.check) return app::check_model(options, model);
  parallel::on_first_rank(MPI_COMM_WORLD, [&] {
    for (const std::string& warning : app::warnings_of_run(model))
      fmt::print(stderr, "WARNING: {}: {}\n", model.file, warning);
  });
  app::check_save(model);  // a long run would be for nothing
  model.analysis ? analyse(options, model) : app::run_in_time(options, model);
}

// An error is the same on all ranks, and one tells it; but for memory, of which one may have less.
void run_on_ranks(const SolveOptions& options) {
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

void add_words(CLI::App& command, SolveOptions& options) {
  command.add_option("model", options.model, "model file (YAML)")->required();
  command.add_option("--end", options.end, "end time, in the model's units (else time: {end} of the model)")
      ->check(app::positive_number);
  command
      .add_option("--step", options.step,
                  "largest time step (else time: {step}, else 0.9 of the stable step)")
      ->check(app::positive_number);
  command.add_flag("--check", options.check,
                   "print size, mass, stable step, run time, memory and what looks like a slip; run nothing");
  command.add_flag("--continue", options.continues,
                   "go on from what an earlier run has saved (time: {save: FILE}), with its files");
  const auto talk = [&](Talk how) { return [&options, how](std::int64_t) { options.talk = how; }; };
  CLI::Option* const quiet = command.add_flag("--quiet", talk(Talk::errors_only), "print nothing but errors");
  command.add_flag("--verbose", talk(Talk::more), "print materials, conditions, energies on the way")
      ->excludes(quiet);
}

}  // namespace

int main(int argc, char** argv) {
  const parallel::Session session(&argc, &argv);
  SolveOptions options;
  CLI::App command("Runs the model file of a NURBS solid without particles: explicit, isogeometric.");
  add_words(command, options);
  return app::run_command(command, argc, argv, options.model, [&] { run_on_ranks(options); });
}
