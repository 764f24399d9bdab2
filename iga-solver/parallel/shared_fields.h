// SPDX-License-Identifier: GPL-2.0-or-later
// Fields for ParaView (io/field_series.h) of a solid on all ranks: all know when a state is due;
// displacements, velocities and what the material remembers are gathered, and rank 0 works out stresses and
// writes.  So the files are the same on any number of ranks.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>

#include "io/field_series.h"
#include "io/history.h"

namespace parallel {

class SharedFields {
 public:
  /// `model.output->fields` is there, and the control points, too: before a solver is built.
  SharedFields(MPI_Comm comm, const io::ModelFile& model);

  /// The solver has got a saved state: the series go on with those of then.
  void resume() { resumes_ = true; }
  /// "plate_volume.pvd, plate_top.pvd"
  const std::string& paths() const { return paths_; }
  /// Collective, before the first step and after each.  Throws std::runtime_error on every rank, naming the
  /// file, if rank 0 cannot write.
  void write_if_due(const structure::ExplicitSolver& solver) {
    if (is_due(solver.time(), solver.time_step())) write(solver);
  }
  /// The same in two calls: whether a state is due at a time, which is asked once, and then the state.
  bool is_due(double time, double step);
  void write(const structure::ExplicitSolver& solver);

 private:
  void open(double time, double step);
  double interval(double step) const { return output_.every ? *output_.every : *output_.steps * step; }

  MPI_Comm comm_;
  io::FieldOutput output_;
  std::string paths_;
  bool resumes_ = false;
  std::optional<io::OutputTimes> times_;   // from the first call on
  std::optional<io::FieldSeries> series_;  // on rank 0
};

}  // namespace parallel
