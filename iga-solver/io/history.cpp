// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "geometry_io/file_lock.h"
#include "geometry_io/regular_file.h"
#include "io/series_file.h"
#include "io/unit_names.h"

namespace io {

std::string checked_path(const HistoryOutput& output) {
  const std::string path = output.file + ".h5";
  const auto fail = [&](const std::string& written, const std::string& problem) {
    throw geometry_io::InputError(fmt::format("{}: output.file is {}: {} is {}, expected another name",
                                              output.place, geometry_io::shown(output.file), written,
                                              problem));
  };
  for (const std::string& written : {path, geometry_io::unfinished_name(path)}) {
    for (const std::string& input : output.inputs)
      if (geometry_io::same_file(written, input))
        fail(written, fmt::format("the file {} that the model is read from and would be overwritten", input));
    if (geometry_io::is_locked(written)) fail(path, "being written by another solid or run");
  }
  return path;
}

struct History::Writer {
  SeriesFile file;
  std::vector<structure::Probe> probes;
  std::vector<structure::NamedSupport> supports;
  int time, kinetic_energy, strain_energy, load_work, linear_momentum, angular_momentum, largest_displacement;
  int work_of_contacts, work_of_loads, work_of_supports, damped, internal_work, truncation;
  std::vector<int> probe_displacement, support_reaction;

  Writer(SeriesFile file_in, std::vector<structure::Probe> probes_in,
         std::vector<structure::NamedSupport> supports_in)
      : file(std::move(file_in)), probes(std::move(probes_in)), supports(std::move(supports_in)) {}
  Writer(const Writer&) = delete;

  /// `series(name, width, unit)` gives a series' index.
  template <class Series>
  void take_series(geometry_io::Units units, Series series) {
    const UnitNames unit = unit_names(units);
    time = series("time", 1, unit.time);
    kinetic_energy = series("kinetic_energy", 1, unit.energy);
    strain_energy = series("strain_energy", 1, unit.energy);
    load_work = series("load_work", 1, unit.energy);
    linear_momentum = series("linear_momentum", 3, unit.momentum);
    angular_momentum = series("angular_momentum", 3, unit.angular_momentum);
    largest_displacement = series("largest_displacement", 1, unit.length);
    for (const structure::Probe& probe : probes)
      probe_displacement.push_back(series("probes/" + probe.name, 3, unit.length));
    work_of_contacts = series("ledger/contacts", 1, unit.energy);
    work_of_loads = series("ledger/loads", 1, unit.energy);
    work_of_supports = series("ledger/supports", 1, unit.energy);
    damped = series("ledger/damped", 1, unit.energy);
    internal_work = series("ledger/internal", 1, unit.energy);
    truncation = series("ledger/truncation", 1, unit.energy);
    for (const structure::NamedSupport& support : supports)
      support_reaction.push_back(series("reactions/" + support.name, 3, unit.force));
  }
  void add_series(geometry_io::Units units) {
    file.set_attribute("units", geometry_io::units_name(units));
    take_series(units, [&](const std::string& name, int width, const char* unit) {
      return file.add_series(name, width, unit);
    });
  }
  /// Rows after `end` are dropped; the time of the last that is left.
  std::optional<double> find_series(geometry_io::Units units, double end) {
    if (file.attribute("units") != geometry_io::units_name(units))
      throw std::runtime_error(fmt::format("{}: units are '{}', expected '{}'", file.path(),
                                           file.attribute("units"), geometry_io::units_name(units)));
    take_series(units, [&](const std::string& name, int width, const char*) {
      return file.find_series(name, width);
    });
    const std::vector<double> times = file.values(time);
    hsize_t rows = 0;
    while (rows < file.rows() && times[rows] <= end) ++rows;
    file.keep_rows(rows);
    if (rows == 0) return {};
    return times[rows - 1];
  }

  void append(int series, double value) { file.append(series, &value); }
  void append(int series, const Vector3& value) { file.append(series, value.data()); }
};

double OutputTimes::next_after(double reached) const { return every_ * (std::floor(reached / every_) + 1.0); }

bool OutputTimes::take(double time, double step) {
  const double reached = time + 0.5 * step;
  // The row that is there may be of another interval, or of none.
  if (last_) next_time_ = std::max(next_time_, next_after(*last_ + 0.5 * step));
  if (reached < next_time_ || (last_ && time <= *last_)) return false;
  next_time_ = next_after(reached);
  last_ = time;  // a next run begins with it, perhaps with a longer step
  return true;
}

History::History(std::unique_ptr<Writer> writer, double every, std::optional<double> last_time)
    : writer_(std::move(writer)), last_time_(last_time), times_(every, last_time) {}

History::History(const HistoryOutput& output, geometry_io::Units units, std::vector<structure::Probe> probes,
                 std::vector<structure::NamedSupport> supports)
    : History(
          std::make_unique<Writer>(SeriesFile(checked_path(output)), std::move(probes), std::move(supports)),
          output.every, {}) {
  writer_->add_series(units);
}

History History::resume(const HistoryOutput& output, geometry_io::Units units,
                        std::vector<structure::Probe> probes, double time,
                        std::vector<structure::NamedSupport> supports) {
  const std::string path = checked_path(output);
  if (!std::filesystem::exists(path)) return {output, units, std::move(probes), std::move(supports)};
  try {
    auto writer = std::make_unique<Writer>(SeriesFile::open(path), std::move(probes), std::move(supports));
    const std::optional<double> last = writer->find_series(units, time);
    return {std::move(writer), output.every, last};
  } catch (const std::runtime_error& problem) {
    throw std::runtime_error(fmt::format(
        "{}; a restarted run goes on with the history of this name: move the file away, or name another",
        problem.what()));
  }
}

History::~History() = default;
History::History(History&&) noexcept = default;

const std::string& History::path() const { return writer_->file.path(); }

void History::record_if_due(const structure::ExplicitSolver& solver) {
  if (times_.take(solver)) record(measure(solver, writer_->probes, writer_->supports));
}

HistoryRow measure(const structure::ExplicitSolver& solver, const std::vector<structure::Probe>& probes,
                   const std::vector<structure::NamedSupport>& supports) {
  const double strain_energy = solver.strain_energy();
  HistoryRow row{solver.time(),
                 solver.kinetic_energy(),
                 strain_energy,
                 solver.load_work(),
                 solver.work(),
                 solver.truncation(strain_energy),
                 solver.linear_momentum(),
                 solver.angular_momentum(Vector3::Zero()),
                 solver.largest_displacement(),
                 {},
                 {}};
  for (const structure::Probe& probe : probes) row.probes.push_back(solver.displacement(probe));
  for (const structure::NamedSupport& support : supports) row.reactions.push_back(solver.reaction(support));
  return row;
}

void History::record(const HistoryRow& row) {
  Writer& w = *writer_;
  w.append(w.kinetic_energy, row.kinetic_energy);
  w.append(w.strain_energy, row.strain_energy);
  w.append(w.load_work, row.load_work);
  w.append(w.linear_momentum, row.linear_momentum);
  w.append(w.angular_momentum, row.angular_momentum);
  w.append(w.largest_displacement, row.largest_displacement);
  for (std::size_t i = 0; i < w.probe_displacement.size(); ++i)
    w.append(w.probe_displacement[i], row.probes[i]);
  w.append(w.work_of_contacts, row.work.forces);
  w.append(w.work_of_loads, row.work.loads);
  w.append(w.work_of_supports, row.work.supports);
  w.append(w.damped, row.work.damped);
  w.append(w.internal_work, row.work.internal);
  w.append(w.truncation, row.truncation);
  for (std::size_t i = 0; i < w.support_reaction.size(); ++i)
    w.append(w.support_reaction[i], row.reactions[i]);
  w.file.end_row(row.time);
  last_time_ = row.time;
}

}  // namespace io
