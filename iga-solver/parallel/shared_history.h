// SPDX-License-Identifier: GPL-2.0-or-later
// Histories (io/history.h) of a solid on all ranks: all know when a row is due, rank 0 writes
// it.
#pragma once

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/history.h"

namespace parallel {

class SharedHistory {
 public:
  SharedHistory(MPI_Comm comm, io::HistoryOutput output, geometry_io::Units units,
                std::vector<structure::Probe> probes, std::vector<structure::NamedSupport> supports = {})
      : comm_(comm),
        output_(std::move(output)),
        units_(units),
        probes_(std::move(probes)),
        supports_(std::move(supports)) {}

  /// The solver has got a saved state: the first row goes on with the file of then, if it is there.
  void resume() { resumes_ = true; }
  /// Of the file, on rank 0, once it is open; else empty.
  std::string path() const { return history_ ? history_->path() : std::string(); }
  /// Collective, before the first step and after each.  The first call opens the file.  Throws
  /// std::runtime_error on every rank, naming the file, if rank 0 cannot write.
  void record_if_due(const structure::ExplicitSolver& solver) {
    if (is_due(solver.time(), solver.time_step())) record(solver);
  }
  /// The same in two calls: whether a row is due at a time, which is asked once, and then the row, changed
  /// by `amend` where somebody else knows better than the solver.
  bool is_due(double time, double step);
  void record(const structure::ExplicitSolver& solver,
              const std::function<void(io::HistoryRow& row)>& amend = {});

 private:
  void open(double time);

  MPI_Comm comm_;
  io::HistoryOutput output_;
  geometry_io::Units units_;
  std::vector<structure::Probe> probes_;
  std::vector<structure::NamedSupport> supports_;
  bool resumes_ = false;
  std::optional<io::OutputTimes> times_;  // from the first call on
  std::optional<io::History> history_;    // the same, on rank 0
};

}  // namespace parallel
