// SPDX-License-Identifier: GPL-2.0-or-later
// Geometry files of all formats, from bytes in memory: who reads a file (rank 0 for all, or this process) is
// the caller's business, and all who have the same bytes reach the same verdict.  README.md of this folder
// lists the formats.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry_io/geometry_file.h"

namespace geometry_io {

/// The name of a row of the table in geometry_io.cpp.
using Format = std::string_view;
namespace format {
constexpr Format yaml = "YAML", hdf5 = "HDF5", xml = "G+Smo XML";
constexpr Format stl = "STL", cad = "STEP or IGES";
}  // namespace format
/// By the file's extension, such as .h5.
std::optional<Format> format_of_path(const std::string& path);
/// ".yaml, .yml, .h5, .hdf5 or .xml": those that write_geometry can write.
std::string written_extensions();

/// Gives the bytes of the file at `path`, or what `readable` makes of them; throws InputError if it
/// cannot.
using ReadFile = std::function<std::string(const std::string& path)>;
/// Reads in this process, `readable` included.
std::string read_file(const std::string& path);
/// The same for STEP and IGES, but surfaces of offset are fitted within a tolerance > 0 [mm].
std::string read_fitted(const std::string& path, double offset_tolerance);
/// For a ReadFile on behalf of many: what an HDF5, STEP or IGES file holds as bytes that the others parse
/// without the libraries that read it, which might crash on a damaged file; other files as they are.
std::string readable(const std::string& path, std::string bytes);

/// Reads a geometry file, YAML unless its extension says otherwise, and another one that it names.  `units`
/// are those of formats that have none. Throws InputError: one line with file and place, what was
/// given and what was expected.
GeometryFile read_geometry(const std::string& path, const ReadFile& read, Units units = Units::si);
/// For model files: what their key `geometry: {file: ...}` reads; its units must be the model's.
OpenGeometry geometry_opener(ReadFile read);

/// The file's bytes; reading them gives the same numbers to the last bit.  Throws std::invalid_argument if
/// the format cannot hold the geometry, or has no writer.
std::string write_geometry(const GeometryFile& geometry, Format format);

/// Writes the file at `path` in the format of its extension, whole or not at all, in place of an older one,
/// and gives that format.  Throws std::runtime_error: one line with `path` and what is wrong, also if it is
/// one of `inputs`, the files that were read.
Format write_geometry_file(const GeometryFile& geometry, const std::string& path,
                           const std::vector<std::string>& inputs);

}  // namespace geometry_io
