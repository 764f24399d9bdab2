// SPDX-License-Identifier: GPL-2.0-or-later
// The key `time` of a model file: how long iga-solve runs a motion, in which steps, and what it saves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry_io/yaml_map.h"
#include "io/output_keys.h"

namespace io {

/// `time: {end: 1e-3, step: 5e-7, save: plate_state.h5, save_every: 1e-4}`
struct TimeSpan {
  double end;                             ///< [time]
  std::optional<double> step = {};        ///< [time]; absent: chosen from the stable step
  std::optional<std::string> save = {};   ///< state file (state_file.h), written at the end ...
  std::optional<double> save_every = {};  ///< ... and every so much time
};

/// `inputs`, and what `output` writes, are files that it must not replace.  Throws geometry_io::InputError.
TimeSpan read_time_span(const geometry_io::YamlMap& map, const std::vector<std::string>& inputs,
                        const std::optional<HistoryOutput>& output);

/// The value of `save`, a file that is none of these.  Throws geometry_io::InputError.
std::string read_save(const geometry_io::YamlMap& map, const std::vector<std::string>& inputs,
                      const std::optional<HistoryOutput>& output);

}  // namespace io
