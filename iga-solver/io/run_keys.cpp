// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/run_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "geometry_io/regular_file.h"

namespace io {

using geometry_io::YamlMap;

namespace {

// One name for every spelling, and for links, also of a file that is not there yet.
std::string one_name(const std::string& path) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path)).string();
}

bool is_state_of_series(const std::string& path, const std::string& stem) {
  const std::string begin = stem + "_", end = ".vtu";
  if (path.size() <= begin.size() + end.size() || path.compare(0, begin.size(), begin) != 0 ||
      path.compare(path.size() - end.size(), end.size(), end) != 0)
    return false;
  return std::all_of(path.begin() + long(begin.size()), path.end() - long(end.size()),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Whether the histories or fields of this output are written to `path`, finished or not.
bool is_written_by(const HistoryOutput& output, const std::string& path) {
  std::vector<std::string> files{output.file + ".h5"}, stems;
  if (output.fields)
    for (const std::string& place : output.fields->on) {
      stems.push_back(output.file + "_" + place);
      files.push_back(stems.back() + ".pvd");
    }
  // Of a link to a file that is not there, the unfinished name alone is the target's.
  const std::string name = one_name(path), unfinished = one_name(geometry_io::unfinished_name(path));
  const auto is_same = [&](const std::string& file) {
    const std::string part = one_name(geometry_io::unfinished_name(file));
    return unfinished == part || unfinished == one_name(file) || name == part ||
           geometry_io::same_file(path, file);
  };
  return std::any_of(files.begin(), files.end(), is_same) ||
         std::any_of(stems.begin(), stems.end(),
                     [&](const std::string& stem) { return is_state_of_series(name, one_name(stem)); });
}

}  // namespace

std::string read_save(const YamlMap& map, const std::vector<std::string>& inputs,
                      const std::optional<HistoryOutput>& output) {
  const std::string path = map.word("save");
  for (const std::string& input : inputs)
    if (geometry_io::same_file(path, input))
      map.fail("save", fmt::format("save is {}, from which the model is read, expected another file",
                                   geometry_io::shown(input)));
  if (output && is_written_by(*output, path))
    map.fail("save", fmt::format("save is {}, which 'output' writes, expected another file",
                                 geometry_io::shown(path)));
  return path;
}

TimeSpan read_time_span(const YamlMap& map, const std::vector<std::string>& inputs,
                        const std::optional<HistoryOutput>& output) {
  map.allow_only({"end", "step", "save", "save_every"});
  TimeSpan time{map.number("end", geometry_io::positive())};
  if (map.has("step")) time.step = map.number("step", geometry_io::positive());
  if (map.has("save")) time.save = read_save(map, inputs, output);
  if (map.has("save_every")) {
    if (!time.save) map.fail("save_every", "save_every is given without a file, expected 'save: FILE', too");
    time.save_every = map.number("save_every", geometry_io::positive());
  }
  return time;
}

}  // namespace io
