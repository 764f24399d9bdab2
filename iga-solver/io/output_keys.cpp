// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/output_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>

#include "geometry_io/regular_file.h"
#include "io/field_places.h"
#include "io/solid_fields.h"

namespace io {

using geometry_io::YamlMap;

namespace {

/// Words that are each one of `known`, none twice.
std::vector<std::string> words_of(const YamlMap& map, const std::string& key,
                                  const std::vector<std::string>& known) {
  std::vector<std::string> words = map.some_words(key, fmt::format("{}", fmt::join(known, ", ")));
  for (auto word = words.begin(); word != words.end(); ++word) {
    if (std::find(known.begin(), known.end(), *word) == known.end()) {
      const std::string nearest = geometry_io::nearest_word(*word, known);
      const std::string hint = nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest);
      map.fail(key, fmt::format("{} has {}, {}expected some of: {}", key, geometry_io::shown(*word), hint,
                                fmt::join(known, ", ")));
    }
    if (std::find(words.begin(), word, *word) != word)
      map.fail(key, fmt::format("{} has '{}' twice, expected once", key, *word));
  }
  return words;
}

double interval(const YamlMap& map, bool without_time) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  return without_time && !map.has("every") ? kNever : map.number("every", geometry_io::positive());
}

/// `fields: [displacement, stress]` comes with the histories, `fields: {of: [...], every: T, on: [...]}` at
/// times and places of its own.
FieldOutput read_fields(const YamlMap& output, const geometry_io::GeometryFile& geometry, bool without_time) {
  if (output.is_list("fields"))
    return {words_of(output, "fields", field_words()), interval(output, without_time)};
  const YamlMap map =
      output.map("fields", "{of: [displacement], every: 1e-5}, or a list: [displacement, stress]");
  map.allow_only({"of", "every", "steps", "on"});
  FieldOutput fields{words_of(map, "of", field_words())};
  if (map.has("every") == map.has("steps") && !(without_time && !map.has("every")))
    output.fail("fields", "fields has 'every' and 'steps' both or neither, expected one of them");
  if (map.has("every") || without_time)
    fields.every = interval(map, without_time);
  else
    fields.steps = map.integer("steps", 1, 1000000000);
  if (!map.has("on")) return fields;
  fields.on = words_of(map, "on", field_places(geometry));
  for (const std::string& place : fields.on)
    if ((place == kVolumePlace || place == kSkinPlace) && geometry.surfaces.count(place) > 0)
      map.fail("on",
               fmt::format("on has '{}', which is {}, and a surface of this model: expected another name "
                           "of the surface",
                           place, place == kSkinPlace ? "the whole skin" : "the whole solid"));
  return fields;
}

/// Of files whose names begin so: a file system takes some 255 bytes, with what is put behind it.
void expect_stem(const YamlMap& map, const HistoryOutput& output) {
  const std::string last = std::filesystem::path(output.file).filename().string();
  if (last.empty() || last == "." || last == "..")
    map.fail(
        "file",
        fmt::format("output.file is '{}', which ends with no name, expected that of a file to begin with",
                    geometry_io::shown(output.file)));
  std::vector<std::string> ends{".h5"};
  if (output.fields)
    for (const std::string& place : output.fields->on)
      ends.push_back(fmt::format("_{}_{}.vtu", place, std::numeric_limits<long>::max()));
  for (const std::string& end : ends) {
    std::error_code problem;
    static_cast<void>(std::filesystem::status(geometry_io::unfinished_name(output.file + end), problem));
    if (problem == std::errc::filename_too_long)
      map.fail("file",
               fmt::format("output.file has a name of {} bytes in a path of {}, expected one that is short "
                           "enough for the file system with '{}' and '.part' behind it",
                           last.size(), output.file.size(), end));
  }
}

}  // namespace

HistoryOutput read_output(const YamlMap& output, const geometry_io::GeometryFile& geometry,
                          const std::vector<std::string>& inputs, bool without_time) {
  output.allow_only({"every", "file", "fields"});
  HistoryOutput result{interval(output, without_time), output.word("file"),
                       fmt::format("{}:{}", output.file(), output.line_of("file")), inputs};
  if (output.has("fields")) result.fields = read_fields(output, geometry, without_time);
  expect_stem(output, result);
  return result;
}

void expect_series_name(const YamlMap& map, const std::string& key, const std::string& name) {
  const std::string separators("/\0", 2);
  if (name == "." || name == ".." || name.find_first_of(separators) != std::string::npos)
    map.fail(key, fmt::format("name '{}' cannot be that of a data set of histories, expected one without '/' "
                              "that is not '.' or '..'",
                              geometry_io::shown(name)));
}

}  // namespace io
