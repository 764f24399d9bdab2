// SPDX-License-Identifier: GPL-2.0-or-later
#include "vtk/vtu_file.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <pugixml.hpp>
#include <stdexcept>

#include "geometry_io/regular_file.h"

namespace vtk {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files are declared LittleEndian");

// RFC 4648, section 4.
std::string base64(const std::vector<unsigned char>& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = bytes[i] << 16;
    if (count > 1) group |= bytes[i + 1] << 8;
    if (count > 2) group |= bytes[i + 2];
    for (std::size_t k = 0; k <= count; ++k) out[k] = kDigits[group >> (18 - 6 * k) & 63u];
    out += 4;
  }
  return text;
}

const char* type_name(const double*) { return "Float64"; }
const char* type_name(const std::int64_t*) { return "Int64"; }
const char* type_name(const std::int32_t*) { return "Int32"; }
const char* type_name(const std::uint8_t*) { return "UInt8"; }

template <class Number>
pugi::xml_node add_array(pugi::xml_node parent, const std::string& name, int components, const Number* values,
                         std::size_t count) {
  const std::uint64_t size = count * sizeof(Number);
  std::vector<unsigned char> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values, size);

  pugi::xml_node array = parent.append_child("DataArray");
  array.append_attribute("type") = type_name(values);
  array.append_attribute("Name") = name.c_str();
  array.append_attribute("NumberOfComponents") = components;
  array.append_attribute("format") = "binary";
  array.text().set(base64(bytes).c_str());
  return array;
}
template <class Number>
pugi::xml_node add_array(pugi::xml_node parent, const std::string& name, int components,
                         const std::vector<Number>& values) {
  return add_array(parent, name, components, values.data(), values.size());
}

// What ParaView shows for the components of a tensor.
void name_tensor_components(pugi::xml_node array) {
  constexpr const char* kNames[] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  for (int i = 0; i < 6; ++i) array.append_attribute(fmt::format("ComponentName{}", i).c_str()) = kNames[i];
}

void add_unit(pugi::xml_node array, const std::string& unit) {
  pugi::xml_node key = array.append_child("InformationKey");
  key.append_attribute("name") = "UNITS_LABEL";
  key.append_attribute("location") = "vtkDataArray";
  key.text().set(unit.c_str());
}

void add_arrays(pugi::xml_node parent, const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    pugi::xml_node array = add_array(parent, field.name, static_cast<int>(field.values.rows()),
                                     field.values.data(), field.values.size());
    if (field.values.rows() == 6) name_tensor_components(array);
    if (!field.unit.empty()) add_unit(array, field.unit);
  }
}

void add_about(pugi::xml_node grid, const About& about) {
  pugi::xml_node data = grid.append_child("FieldData");
  add_array(data, "TimeValue", 1, &about.time, 1).append_attribute("NumberOfTuples") = 1;
  if (about.units.empty()) return;
  const std::vector<std::uint8_t> text(about.units.c_str(), about.units.c_str() + about.units.size() + 1);
  pugi::xml_node units = add_array(data, "UNITS", 1, text);
  units.attribute("type") = "String";
  units.append_attribute("NumberOfTuples") = 1;
}

pugi::xml_node start(pugi::xml_document& document, const char* type, const char* version) {
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = type;
  root.append_attribute("version") = version;
  root.append_attribute("byte_order") = "LittleEndian";
  return root;
}

void save(const pugi::xml_document& document, const std::string& path) {
  const std::string problem = geometry_io::write_file(
      path, [&](std::ostream& file) { document.save(file, " ", pugi::format_indent); });
  if (!problem.empty()) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, problem));
}

void write_cells(const std::string& path, const BezierCells& cells, const About& about) {
  pugi::xml_document document;
  pugi::xml_node root = start(document, "UnstructuredGrid", "2.2");
  root.append_attribute("header_type") = "UInt64";
  pugi::xml_node grid = root.append_child("UnstructuredGrid");
  add_about(grid, about);
  pugi::xml_node piece = grid.append_child("Piece");
  piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(cells.points.size() / 3);
  piece.append_attribute("NumberOfCells") = static_cast<unsigned long long>(cells.offsets.size());

  pugi::xml_node point_data = piece.append_child("PointData");
  add_arrays(point_data, cells.point_fields);
  if (!cells.weights.empty()) {
    point_data.append_attribute("RationalWeights") = "weights";
    add_array(point_data, "weights", 1, cells.weights);
  }
  pugi::xml_node cell_data = piece.append_child("CellData");
  add_arrays(cell_data, cells.cell_fields);
  if (!cells.degrees.empty()) {
    cell_data.append_attribute("HigherOrderDegrees") = "degrees";
    add_array(cell_data, "degrees", 3, cells.degrees);
  }

  add_array(piece.append_child("Points"), "points", 3, cells.points);
  pugi::xml_node topology = piece.append_child("Cells");
  add_array(topology, "connectivity", 1, cells.connectivity);
  add_array(topology, "offsets", 1, cells.offsets);
  add_array(topology, "types", 1, std::vector<std::uint8_t>(cells.offsets.size(), cells.cell_type));
  save(document, path);
}

// 20 of "wall_20.vtu"
long step_of(const std::string& file) {
  const std::size_t underscore = file.rfind('_');
  return underscore == std::string::npos ? 0 : std::atol(file.c_str() + underscore + 1);
}

}  // namespace

template <int Dim>
void write_vtu(const std::string& path, const std::vector<PatchFields<Dim>>& patches, const About& about) {
  write_cells(path, bezier_cells(patches), about);
}

void write_vtu(const std::string& path, const TriangleFields& triangles, const About& about) {
  write_cells(path, triangle_cells(triangles), about);
}

std::vector<Series::Entry> Series::entries_of_file() const {
  if (!std::filesystem::exists(path())) return {};
  pugi::xml_document document;
  if (!document.load_file(path().c_str()) || !document.child("VTKFile").child("Collection"))
    throw std::runtime_error(
        fmt::format("'{}' is no ParaView series, so it cannot be continued: remove it", path()));
  std::vector<Entry> entries;
  for (pugi::xml_node entry : document.child("VTKFile").child("Collection").children("DataSet"))
    entries.emplace_back(entry.attribute("timestep").as_double(), entry.attribute("file").as_string());
  return entries;
}

void Series::resume(long step) {
  for (Entry& entry : entries_of_file())
    if (step_of(entry.second) <= step) entries_.push_back(std::move(entry));
}

std::optional<double> Series::resume_at(double time) {
  for (Entry& entry : entries_of_file())
    if (entry.first <= time) entries_.push_back(std::move(entry));
  if (entries_.empty()) return {};
  return entries_.back().first;
}

template <class Fields>
void Series::write(long step, double time, const Fields& fields) {
  const std::string file = fmt::format("{}_{}.vtu", stem_, step);
  write_vtu(file, fields, {time, units_});
  entries_.emplace_back(time, std::filesystem::path(file).filename().string());
  write_index();
}

void Series::write_index() const {
  pugi::xml_document document;
  pugi::xml_node collection = start(document, "Collection", "0.1").append_child("Collection");
  for (const auto& [time, file] : entries_) {
    pugi::xml_node entry = collection.append_child("DataSet");
    entry.append_attribute("timestep") = fmt::format("{:.17g}", time).c_str();
    entry.append_attribute("file") = file.c_str();
  }
  save(document, path());
}

template void write_vtu(const std::string&, const std::vector<PatchFields<2>>&, const About&);
template void write_vtu(const std::string&, const std::vector<PatchFields<3>>&, const About&);
template void Series::write(long, double, const std::vector<PatchFields<2>>&);
template void Series::write(long, double, const std::vector<PatchFields<3>>&);
template void Series::write(long, double, const TriangleFields&);

}  // namespace vtk
