// SPDX-License-Identifier: GPL-2.0-or-later
// How a condition of a model file changes in time: `time: {ramp: [from, to]}`, `{sine: {frequency: f, phase:
// radians}}` or `{table: [[t, value], ...]}`, or an expression
// of t, `time: 1 - cos(2*pi*50*t)`.
#pragma once

#include "geometry_io/yaml_map.h"
#include "structure/conditions/time_function.h"

namespace io {

/// That of the key `time`; none without it.  Throws geometry_io::InputError.
structure::TimeFunction read_time_function(const geometry_io::YamlMap& map);

}  // namespace io
