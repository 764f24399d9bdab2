// SPDX-License-Identifier: GPL-2.0-or-later
// A CAD model in our HDF5 schema, version 2; README.md of this folder lists it.
#pragma once

#include "brep/cad_model.h"
#include "geometry_io/hdf5_builder.h"

namespace geometry_io {

class Hdf5Input;

/// A whole file.
void add_cad_file(const brep::CadModel& model, const std::string& units, Hdf5Builder& file);
/// The same, read and checked; `patches` are those of the file.  Throws InputError.
brep::CadModel read_cad(const Hdf5Input& file, std::vector<nurbs::Surface> patches);

}  // namespace geometry_io
