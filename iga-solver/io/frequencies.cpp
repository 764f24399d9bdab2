// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/frequencies.h"

#include <cmath>

#include "io/history.h"
#include "io/series_file.h"
#include "io/unit_names.h"

namespace io {

void write_frequencies(const HistoryOutput& output, geometry_io::Units units,
                       const std::vector<structure::Mode>& modes, const Eigen::VectorXd& nodal_mass) {
  SeriesFile file(checked_path(output));
  file.set_attribute("units", geometry_io::units_name(units));
  const UnitNames unit = unit_names(units);
  const std::string per_time = std::string("1/") + unit.time;
  const int number = file.add_series("mode", 1, "1"), frequency = file.add_series("frequency", 1, per_time),
            angular = file.add_series("angular_frequency", 1, std::string("rad/") + unit.time),
            effective = file.add_series("effective_mass", 3, unit.mass);
  static_cast<void>(number);  // the first: end_row's
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double f = modes[k].frequency(), omega = std::sqrt(std::max(0.0, modes[k].eigenvalue));
    const nurbs::Vector3 moved = (modes[k].shape * nodal_mass).cwiseAbs2();
    file.append(frequency, &f);
    file.append(angular, &omega);
    file.append(effective, moved.data());
    file.end_row(static_cast<double>(k) + 1.0);
  }
}

}  // namespace io
