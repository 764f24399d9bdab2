// SPDX-License-Identifier: GPL-2.0-or-later
// Histories of a run in HDF5: one row per output time.  README.md of this folder lists the data sets.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/model_file.h"

namespace io {

/// Times 0, every, 2 every, ..., each met by the nearest step.
class OutputTimes {
 public:
  /// `last`: the time of a row that is there already.
  explicit OutputTimes(double every, std::optional<double> last = {}) : every_(every), last_(last) {}
  /// Whether the solver has reached the next one, to within half a step; if so, it lies behind from now on.
  bool take(const structure::ExplicitSolver& solver) { return take(solver.time(), solver.time_step()); }
  bool take(double time, double step);
  /// From now on multiples of another interval.
  void set_interval(double every) { every_ = every; }

 private:
  double next_after(double reached) const;

  double every_, next_time_ = 0.0;
  std::optional<double> last_;
};

/// One row, in the order of the file's data sets.
struct HistoryRow {
  double time, kinetic_energy, strain_energy, load_work;
  structure::Work work;
  double truncation;
  Vector3 linear_momentum, angular_momentum;
  double largest_displacement;
  std::vector<Vector3> probes;     ///< displacements
  std::vector<Vector3> reactions;  ///< of supports
};
/// Collective, as what it asks of the solver.
HistoryRow measure(const structure::ExplicitSolver& solver, const std::vector<structure::Probe>& probes,
                   const std::vector<structure::NamedSupport>& supports = {});

/// The path of the file of `output`, NAME.h5.  Throws geometry_io::InputError as History.
std::string checked_path(const HistoryOutput& output);

class History {
 public:
  /// Creates `<output.file>.h5`, replacing an older one.  Throws std::runtime_error, naming the file, if that
  /// fails, and geometry_io::InputError if it is one of `output.inputs`, by whatever name or link, or the
  /// file of another history, of this process or another.
  History(const HistoryOutput& output, geometry_io::Units units, std::vector<structure::Probe> probes,
          std::vector<structure::NamedSupport> supports = {});
  /// Goes on with the file of an earlier run, from `time`: later rows are dropped, and come anew.  Without
  /// such a file as above.  Throws std::runtime_error if it is the file of something else, which it leaves as
  /// it is.
  static History resume(const HistoryOutput& output, geometry_io::Units units,
                        std::vector<structure::Probe> probes, double time,
                        std::vector<structure::NamedSupport> supports = {});
  ~History();
  History(History&&) noexcept;

  /// Appends a row if the next output time is reached (to within half a step): times 0, every, 2 every, ...
  void record_if_due(const structure::ExplicitSolver& solver);
  /// Appends a row and flushes: what was recorded survives a killed run.
  void record(const HistoryRow& row);
  const std::string& path() const;
  /// Time of the last row, if there is one.
  std::optional<double> last_time() const { return last_time_; }

 private:
  struct Writer;
  History(std::unique_ptr<Writer> writer, double every, std::optional<double> last_time);

  std::unique_ptr<Writer> writer_;
  std::optional<double> last_time_;
  OutputTimes times_;
};

}  // namespace io
