// SPDX-License-Identifier: GPL-2.0-or-later
// Histories of a run in HDF5: one row per output time.  README.md of this folder lists the data sets.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/model_file.h"

namespace io {

class History {
 public:
  /// Creates `<output.file>.h5`, replacing an older one.  Throws std::runtime_error, naming the file, if that
  /// fails.
  History(const HistoryOutput& output, nurbs::Units units, std::vector<structure::Probe> probes);
  ~History();
  History(History&&) noexcept;

  /// Appends a row if the next output time is reached (to within half a step): times 0, every, 2 every, ...
  void record_if_due(const structure::ExplicitSolver& solver);
  /// Appends a row and flushes: what was recorded survives a killed run.
  void record(const structure::ExplicitSolver& solver);
  const std::string& path() const;

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
  double every_;
  double next_time_ = 0.0;
};

}  // namespace io
