// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/geometry_io.h"

#include <fmt/format.h>

#include <filesystem>

#include "geometry_io/formats.h"
#include "geometry_io/hdf5_file.h"
#include "geometry_io/regular_file.h"

namespace geometry_io {
namespace {

struct FormatEntry {
  Format format;
  const char* name;
  std::initializer_list<const char*> extensions;
  GeometryFile (*parse)(const std::string& bytes, const std::string& file, Units units);
  std::string (*write)(const GeometryFile& geometry);
};

GeometryFile parse_yaml(const std::string& text, const std::string& file, Units) {
  return parse_geometry_file(text, file);
}

const FormatEntry kFormats[] = {
    {Format::yaml, "YAML", {".yaml", ".yml"}, parse_yaml, write_yaml},
    {Format::hdf5, "HDF5", {".h5", ".hdf5"}, parse_hdf5, write_hdf5},
    {Format::xml, "G+Smo XML", {".xml"}, parse_gismo, write_gismo},
};
const FormatEntry& entry(Format format) { return kFormats[static_cast<int>(format)]; }

Format input_format(const std::string& path) { return format_of_path(path).value_or(Format::yaml); }

// The file that a geometry file names names no further one.
GeometryFile read_other_file(const std::string& path, Units units, const ReadFile& read) {
  GeometryFile geometry = entry(input_format(path)).parse(read(path), path, units);
  if (geometry.units != units)
    throw InputError(fmt::format("{}: units are {}, expected {} as in the file that names this one", path,
                                 units_name(geometry.units), units_name(units)));
  return geometry;
}

}  // namespace

const char* format_name(Format format) { return entry(format).name; }

std::optional<Format> format_of_path(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const FormatEntry& known : kFormats)
    for (const char* one : known.extensions)
      if (extension == one) return known.format;
  return std::nullopt;
}

std::string read_file(const std::string& path) {
  FileContent content = read_regular_file(path);
  if (!content.problem.empty())
    throw InputError(fmt::format("{}: cannot read this file: {}", path, content.problem));
  return readable(path, std::move(content.bytes));
}

std::string readable(const std::string& path, std::string bytes) {
  if (input_format(path) == Format::hdf5) return unpacked_hdf5(bytes, path);
  return bytes;
}

GeometryFile read_geometry(const std::string& path, const ReadFile& read, Units units) {
  const Format format = input_format(path);
  const std::string bytes = read(path);
  if (format == Format::yaml) return parse_geometry_file(bytes, path, geometry_opener(read));
  return entry(format).parse(bytes, path, units);
}

OpenGeometry geometry_opener(ReadFile read) {
  return [read = std::move(read)](const std::string& path, Units units) {
    return read_other_file(path, units, read);
  };
}

std::string write_geometry(const GeometryFile& geometry, Format format) {
  return entry(format).write(geometry);
}

}  // namespace geometry_io
