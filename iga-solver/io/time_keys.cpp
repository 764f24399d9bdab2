// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/time_keys.h"

#include <fmt/format.h>

#include <stdexcept>

#include "io/expression.h"

namespace io {

using geometry_io::YamlMap;

namespace {

structure::TimeFunction read_ramp(const YamlMap& map) {
  const std::vector<double> times = map.numbers("ramp");
  if (times.size() != 2 || !(times[0] < times[1]))
    map.fail("ramp", "ramp is of another form, expected two rising times, [from, to]");
  return structure::ramp(times[0], times[1]);
}

structure::TimeFunction read_sine(const YamlMap& map) {
  const YamlMap sine = map.map("sine", "{frequency: 50}");
  sine.allow_only({"frequency", "phase"});
  return structure::sine(sine.number("frequency", geometry_io::positive()),
                         sine.has("phase") ? sine.number("phase") : 0.0);
}

structure::TimeFunction read_table(const YamlMap& map) {
  std::vector<std::array<double, 2>> rows;
  for (const std::vector<double>& row : map.table("table")) {
    if (row.size() != 2)
      map.fail("table", fmt::format("table has a row of {} numbers, expected [t, value]", row.size()));
    rows.push_back({row[0], row[1]});
  }
  try {
    return structure::table(std::move(rows));
  } catch (const std::invalid_argument& problem) {
    map.fail("table", fmt::format("table: {}", problem.what()));
  }
}

}  // namespace

structure::TimeFunction read_time_function(const YamlMap& entry) {
  if (!entry.has("time")) return {};
  if (!entry.is_map("time")) return read_time_expression(entry, "time");
  const YamlMap map = entry.map("time");
  map.allow_only({"ramp", "sine", "table"});
  const std::vector<std::string> keys = map.keys();
  if (keys.size() != 1)
    entry.fail("time", fmt::format("time has {} keys, expected one of: ramp, sine, table", keys.size()));
  if (keys[0] == "ramp") return read_ramp(map);
  return keys[0] == "sine" ? read_sine(map) : read_table(map);
}

}  // namespace io
