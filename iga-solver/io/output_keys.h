// SPDX-License-Identifier: GPL-2.0-or-later
// The key `output` of a model file: what a run writes, when, and to which files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry_io/geometry_file.h"

namespace io {

/// Fields for ParaView.
struct FieldOutput {
  std::vector<std::string> of;               ///< words of solid_fields.h
  std::optional<double> every = {};          ///< interval [time] ...
  std::optional<int> steps = {};             ///< ... or so many time steps of the solid
  std::vector<std::string> on = {"volume"};  ///< places (field_series.h), each a series of files
};

/// Histories, and perhaps fields.
struct HistoryOutput {
  double every;                          ///< interval [time]
  std::string file;                      ///< without ".h5"; relative to the current directory unless absolute
  std::string place = {};                ///< "plate.yaml:12", for messages
  std::vector<std::string> inputs = {};  ///< the files that the model was read from: never to be replaced
  std::optional<FieldOutput> fields = {};
};

/// `without_time`: of an analysis whose every result is written, so that there is no `every`.  Throws
/// geometry_io::InputError as all readers of model files.
HistoryOutput read_output(const geometry_io::YamlMap& output, const geometry_io::GeometryFile& geometry,
                          const std::vector<std::string>& inputs, bool without_time = false);

/// A probe or support has a data set of its name in histories.  Throws geometry_io::InputError, at the key,
/// unless HDF5 takes the name for one.
void expect_series_name(const geometry_io::YamlMap& map, const std::string& key, const std::string& name);

}  // namespace io
