// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/shared_fields.h"

#include <cmath>
#include <limits>

#include "parallel/all_or_none.h"

namespace parallel {

SharedFields::SharedFields(MPI_Comm comm, const io::ModelFile& model)
    : comm_(comm), output_(*model.output->fields) {
  on_first_rank(comm_, [&] { series_.emplace(model); });
  for (const std::string& place : output_.on)
    paths_ += (paths_.empty() ? "" : ", ") + model.output->file + "_" + place + ".pvd";
}

void SharedFields::open(double time, double step) {
  double last = std::numeric_limits<double>::quiet_NaN();  // no state yet
  if (resumes_) on_first_rank(comm_, [&] { last = series_->resume(time).value_or(last); });
  MPI_Bcast(&last, 1, MPI_DOUBLE, 0, comm_);
  times_.emplace(interval(step), std::isnan(last) ? std::optional<double>() : last);
}

bool SharedFields::is_due(double time, double step) {
  if (!times_) open(time, step);
  times_->set_interval(interval(step));
  return times_->take(time, step);
}

void SharedFields::write(const structure::ExplicitSolver& solver) {
  const io::SolidState state{solver.time(), nurbs::nodal_vectors(solver.in_order(solver.displacements())),
                             nurbs::nodal_vectors(solver.in_order(solver.velocities())),
                             solver.memory_in_order()};
  on_first_rank(comm_, [&] { series_->write(state); });
}

}  // namespace parallel
