// SPDX-License-Identifier: GPL-2.0-or-later
// The key `damping` of a model file: {mass: 20, stiffness: 1e-7, modal: 0.01}.
#pragma once

#include <vector>

#include "geometry_io/geometry_file.h"

namespace io {

struct DampingKeys {
  double mass = 0.0;               ///< rate [1/time]
  double stiffness = 0.0;          ///< [time]
  std::vector<double> modal = {};  ///< of critical damping, of the first modes; the last of all others
};

/// Of volumes.  Throws geometry_io::InputError.
DampingKeys read_damping(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry);

}  // namespace io
