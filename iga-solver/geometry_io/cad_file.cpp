// SPDX-License-Identifier: GPL-2.0-or-later
// STEP and IGES by the program nurbs-read-step.
#include <fmt/format.h>

#include <new>
#include <stdexcept>

#include "geometry_io/cad_hdf5.h"
#include "geometry_io/cad_placement.h"
#include "geometry_io/file_kind.h"
#include "geometry_io/formats.h"
#include "geometry_io/reader_process.h"
#include "nurbs/memory.h"

namespace geometry_io {
namespace {

double units_per_mm(Units units) {
  switch (units) {
    case Units::si:
      return 1e-3;
    case Units::cgs:
      return 0.1;
    default:
      return 1.0;
  }
}

}  // namespace

std::string unpacked_cad(const std::string& bytes, const std::string& file, double offset_tolerance) {
  if (bytes.empty()) throw InputError(file + ": the file is empty, expected a STEP or IGES file");
  const FileKind kind = kind_of_file(file, bytes);
  if (kind == FileKind::binary)
    throw InputError(file + ": is a binary file, expected a STEP or IGES file, which are text");
  if (kind != FileKind::step && kind != FileKind::iges) expect_kind(FileKind::step, file, bytes);
  try {
    if (offset_tolerance > 0.0)
      return read_in_own_process(kStepReader, bytes, {fmt::format("{}", offset_tolerance)});
    return read_in_own_process(kStepReader, bytes);
  } catch (const std::bad_alloc&) {
    throw InputError(nurbs::out_of_memory(file));
  } catch (const std::runtime_error& error) {
    throw InputError(file + ": " + error.what());
  }
}

GeometryFile parse_cad(const std::string& bytes, const std::string& file, Units units) {
  GeometryFile geometry = parse_hdf5(is_encoded(bytes) ? bytes : unpacked_cad(bytes, file), file, units);
  if (!geometry.cad) throw InputError(file + ": holds no CAD model, expected STEP or IGES by its name");
  geometry.units = units;
  brep::CadModel model = *geometry.cad;
  if (units_per_mm(units) != 1.0) place(model, scaling(nurbs::Vector3::Constant(units_per_mm(units))));
  geometry.cad = std::make_shared<const brep::CadModel>(std::move(model));
  return geometry;
}

}  // namespace geometry_io
