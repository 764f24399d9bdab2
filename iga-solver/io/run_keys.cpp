// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/run_keys.h"

#include <fmt/format.h>

#include "geometry_io/regular_file.h"

namespace io {

using geometry_io::YamlMap;

std::string read_save(const YamlMap& map, const std::vector<std::string>& inputs) {
  const std::string path = map.word("save");
  for (const std::string& input : inputs)
    if (geometry_io::same_file(path, input))
      map.fail("save", fmt::format("save is {}, from which the model is read, expected another file",
                                   geometry_io::shown(input)));
  return path;
}

TimeSpan read_time_span(const YamlMap& map, const std::vector<std::string>& inputs) {
  map.allow_only({"end", "step", "save", "save_every"});
  TimeSpan time{map.number("end", geometry_io::positive())};
  if (map.has("step")) time.step = map.number("step", geometry_io::positive());
  if (map.has("save")) time.save = read_save(map, inputs);
  if (map.has("save_every")) {
    if (!time.save) map.fail("save_every", "save_every is given without a file, expected 'save: FILE', too");
    time.save_every = map.number("save_every", geometry_io::positive());
  }
  return time;
}

}  // namespace io
