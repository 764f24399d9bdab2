// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/geometry_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "geometry_io/formats.h"
#include "geometry_io/hdf5_file.h"
#include "geometry_io/regular_file.h"

namespace geometry_io {
namespace {

struct FormatEntry {
  Format name;
  std::initializer_list<const char*> extensions;
  GeometryFile (*parse)(const std::string& bytes, const std::string& file, Units units);
  std::string (*write)(const GeometryFile& geometry);  // null: files are read only
};

GeometryFile parse_yaml(const std::string& text, const std::string& file, Units) {
  return parse_geometry_file(text, file);
}

const FormatEntry kFormats[] = {
    {format::yaml, {".yaml", ".yml"}, parse_yaml, write_yaml},
    {format::hdf5, {".h5", ".hdf5"}, parse_hdf5, write_hdf5},
    {format::xml, {".xml"}, parse_gismo, write_gismo},
    {format::stl, {".stl", ".STL"}, parse_stl, nullptr},
    {format::cad,
     {".step", ".stp", ".p21", ".STEP", ".STP", ".iges", ".igs", ".IGES", ".IGS"},
     parse_cad,
     nullptr},
};
const FormatEntry& entry(Format format) {
  for (const FormatEntry& known : kFormats)
    if (known.name == format) return known;
  throw std::invalid_argument(fmt::format("there is no geometry format '{}'", format));
}

Format input_format(const std::string& path) { return format_of_path(path).value_or(format::yaml); }

std::string bytes_of(const std::string& path) {
  FileContent content = read_regular_file(path);
  if (!content.problem.empty())
    throw InputError(fmt::format("{}: cannot read this file: {}", path, content.problem));
  return std::move(content.bytes);
}

// The file that a geometry file names names no further one.
GeometryFile read_other_file(const std::string& path, Units units, const ReadFile& read) {
  GeometryFile geometry = entry(input_format(path)).parse(read(path), path, units);
  if (geometry.units != units)
    throw InputError(fmt::format("{}: units are {}, expected {} as in the file that names this one", path,
                                 units_name(geometry.units), units_name(units)));
  return geometry;
}

}  // namespace

std::optional<Format> format_of_path(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const FormatEntry& known : kFormats)
    for (const char* one : known.extensions)
      if (extension == one) return known.name;
  return std::nullopt;
}

std::string written_extensions() {
  std::vector<std::string> found;
  for (const FormatEntry& known : kFormats)
    if (known.write) found.insert(found.end(), known.extensions.begin(), known.extensions.end());
  const std::string last = found.back();
  found.pop_back();
  return fmt::format("{} or {}", fmt::join(found, ", "), last);
}

std::string read_file(const std::string& path) { return readable(path, bytes_of(path)); }

std::string read_fitted(const std::string& path, double offset_tolerance) {
  if (input_format(path) != format::cad)
    throw InputError(path + ": a tolerance for surfaces of offset, expected a STEP or IGES file");
  return unpacked_cad(bytes_of(path), path, offset_tolerance);
}

std::string readable(const std::string& path, std::string bytes) {
  const Format format = input_format(path);
  if (format == format::hdf5) return unpacked_hdf5(bytes, path);
  if (format == format::cad) return unpacked_cad(bytes, path);
  return bytes;
}

GeometryFile read_geometry(const std::string& path, const ReadFile& read, Units units) {
  const Format format = input_format(path);
  const std::string bytes = read(path);
  if (format == format::yaml) return parse_geometry_file(bytes, path, geometry_opener(read));
  return entry(format).parse(bytes, path, units);
}

OpenGeometry geometry_opener(ReadFile read) {
  return [read = std::move(read)](const std::string& path, Units units) {
    return read_other_file(path, units, read);
  };
}

std::string write_geometry(const GeometryFile& geometry, Format format) {
  const FormatEntry& known = entry(format);
  if (!known.write)
    throw std::invalid_argument(
        fmt::format("{} files are read, not written, expected {}", format, written_extensions()));
  if (geometry.cad && format != format::hdf5)
    throw std::invalid_argument(
        fmt::format("{} holds no faces of a CAD file, expected HDF5 (.h5 or .hdf5)", format));
  if (std::any_of(geometry.patches.begin(), geometry.patches.end(), is_triangles))
    throw std::invalid_argument(
        fmt::format("{} holds no triangles (STL), expected NURBS patches: a file in YAML takes triangles by "
                    "'geometry: {{file: NAME.stl}}'",
                    format));
  return known.write(geometry);
}

Format write_geometry_file(const GeometryFile& geometry, const std::string& path,
                           const std::vector<std::string>& inputs) {
  const auto format = format_of_path(path);
  if (!format)
    throw std::runtime_error(fmt::format("{}: unknown extension, expected {}", path, written_extensions()));
  std::string bytes;
  try {
    bytes = write_geometry(geometry, *format);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
  for (const std::string& input : inputs)
    for (const std::string& written : {path, unfinished_name(path)})
      if (same_file(written, input))
        throw std::runtime_error(
            fmt::format("{}: is the file {} that is read and would be overwritten, expected another name",
                        written, input));
  const std::string problem = write_file(path, [&](std::ostream& file) { file << bytes; });
  if (!problem.empty()) throw std::runtime_error(fmt::format("{}: cannot write here: {}", path, problem));
  return *format;
}

}  // namespace geometry_io
