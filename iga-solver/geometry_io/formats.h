// SPDX-License-Identifier: GPL-2.0-or-later
// The formats behind geometry_io.h.  Readers throw InputError, writers std::invalid_argument.
#pragma once

#include <string>

#include "geometry_io/geometry_file.h"

namespace geometry_io {

std::string write_yaml(const GeometryFile& geometry);

/// `units` are not used: HDF5 files have their own.
GeometryFile parse_hdf5(const std::string& bytes, const std::string& file, Units units);
std::string write_hdf5(const GeometryFile& geometry);

/// STEP and IGES: bytes, or what unpacked_cad makes of them; `units` are those of the model.
GeometryFile parse_cad(const std::string& bytes, const std::string& file, Units units);
/// The model as bytes that others can parse without OpenCASCADE, by a process of its own (reader_process.h).
/// Surfaces of offset are fitted within `offset_tolerance` [mm], or refused if it is 0.  Throws InputError.
std::string unpacked_cad(const std::string& bytes, const std::string& file, double offset_tolerance = 0.0);

/// `units` are those of a file without.
GeometryFile parse_gismo(const std::string& text, const std::string& file, Units units);
std::string write_gismo(const GeometryFile& geometry);

/// `units` are those of the numbers.  Blocks `solid` are patches; the surfaces are their names, and `all`.
GeometryFile parse_stl(const std::string& bytes, const std::string& file, Units units);

}  // namespace geometry_io
