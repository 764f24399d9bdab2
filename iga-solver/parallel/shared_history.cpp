// SPDX-License-Identifier: GPL-2.0-or-later
#include "parallel/shared_history.h"

#include <cmath>
#include <limits>

#include "parallel/all_or_none.h"

namespace parallel {

void SharedHistory::open(double time) {
  double last = std::numeric_limits<double>::quiet_NaN();  // no row yet
  on_first_rank(comm_, [&] {
    history_.emplace(resumes_ ? io::History::resume(output_, units_, probes_, time, supports_)
                              : io::History(output_, units_, probes_, supports_));
    last = history_->last_time().value_or(last);
  });
  MPI_Bcast(&last, 1, MPI_DOUBLE, 0, comm_);
  times_.emplace(output_.every, std::isnan(last) ? std::optional<double>() : last);
}

bool SharedHistory::is_due(double time, double step) {
  if (!times_) open(time);
  return times_->take(time, step);
}

void SharedHistory::record(const structure::ExplicitSolver& solver,
                           const std::function<void(io::HistoryRow& row)>& amend) {
  io::HistoryRow row = io::measure(solver, probes_, supports_);
  if (amend) amend(row);
  on_first_rank(comm_, [&] { history_->record(row); });
}

}  // namespace parallel
