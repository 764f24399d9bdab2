// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/history.h"

#include <cmath>

#include "io/series_file.h"

namespace io {

namespace {

struct UnitNames {
  const char *time, *length, *energy, *momentum, *angular_momentum;
};

UnitNames unit_names(nurbs::Units units) {
  switch (units) {
    case nurbs::Units::cgs:
      return {"s", "cm", "erg", "g cm/s", "g cm^2/s"};
    case nurbs::Units::mm_g_ms:
      return {"ms", "mm", "mJ", "g mm/ms", "g mm^2/ms"};
    case nurbs::Units::si:
      break;
  }
  return {"s", "m", "J", "kg m/s", "kg m^2/s"};
}

}  // namespace

struct History::Writer {
  SeriesFile file;
  std::vector<structure::Probe> probes;
  int time, kinetic_energy, strain_energy, load_work, linear_momentum, angular_momentum, largest_displacement;
  std::vector<int> probe_displacement;

  Writer(const std::string& path, nurbs::Units units, std::vector<structure::Probe> probes_in)
      : file(path), probes(std::move(probes_in)) {
    const UnitNames unit = unit_names(units);
    file.set_attribute("units", nurbs::units_name(units));
    time = file.add_series("time", 1, unit.time);
    kinetic_energy = file.add_series("kinetic_energy", 1, unit.energy);
    strain_energy = file.add_series("strain_energy", 1, unit.energy);
    load_work = file.add_series("load_work", 1, unit.energy);
    linear_momentum = file.add_series("linear_momentum", 3, unit.momentum);
    angular_momentum = file.add_series("angular_momentum", 3, unit.angular_momentum);
    largest_displacement = file.add_series("largest_displacement", 1, unit.length);
    for (const structure::Probe& probe : probes)
      probe_displacement.push_back(file.add_series("probes/" + probe.name, 3, unit.length));
  }

  void append(int series, double value) { file.append(series, &value); }
  void append(int series, const Vector3& value) { file.append(series, value.data()); }
};

History::History(const HistoryOutput& output, nurbs::Units units, std::vector<structure::Probe> probes)
    : writer_(std::make_unique<Writer>(output.file + ".h5", units, std::move(probes))),
      every_(output.every) {}

History::~History() = default;
History::History(History&&) noexcept = default;

const std::string& History::path() const { return writer_->file.path(); }

void History::record_if_due(const structure::ExplicitSolver& solver) {
  const double reached = solver.time() + 0.5 * solver.time_step();
  if (reached < next_time_) return;
  record(solver);
  next_time_ = every_ * (std::floor(reached / every_) + 1.0);
}

void History::record(const structure::ExplicitSolver& solver) {
  Writer& w = *writer_;
  w.append(w.time, solver.time());
  w.append(w.kinetic_energy, solver.kinetic_energy());
  w.append(w.strain_energy, solver.strain_energy());
  w.append(w.load_work, solver.load_work());
  w.append(w.linear_momentum, solver.linear_momentum());
  w.append(w.angular_momentum, solver.angular_momentum(Vector3::Zero()));
  w.append(w.largest_displacement, solver.displacements().colwise().norm().maxCoeff());
  for (std::size_t i = 0; i < w.probes.size(); ++i)
    w.append(w.probe_displacement[i], solver.displacement(w.probes[i].xi));
  w.file.flush();
}

}  // namespace io
