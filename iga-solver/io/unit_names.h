// SPDX-License-Identifier: GPL-2.0-or-later
// What the files that are written call the units of their numbers.
#pragma once

#include "geometry_io/geometry_file.h"

namespace io {

struct UnitNames {
  const char *time, *length, *velocity, *force, *stress, *energy, *energy_density, *momentum,
      *angular_momentum, *mass;
};

inline UnitNames unit_names(geometry_io::Units units) {
  switch (units) {
    case geometry_io::Units::cgs:
      return {"s", "cm", "cm/s", "dyn", "dyn/cm^2", "erg", "erg/cm^3", "g cm/s", "g cm^2/s", "g"};
    case geometry_io::Units::mm_g_ms:
      return {"ms", "mm", "mm/ms", "N", "MPa", "mJ", "mJ/mm^3", "g mm/ms", "g mm^2/ms", "g"};
    case geometry_io::Units::mm_t_s:
      return {"s", "mm", "mm/s", "N", "MPa", "mJ", "mJ/mm^3", "t mm/s", "t mm^2/s", "t"};
    case geometry_io::Units::si:
      break;
  }
  return {"s", "m", "m/s", "N", "Pa", "J", "J/m^3", "kg m/s", "kg m^2/s", "kg"};
}

}  // namespace io
