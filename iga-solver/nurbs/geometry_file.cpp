// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/geometry_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "nurbs/shape_reader.h"

namespace nurbs {
namespace {

constexpr const char* kUnitsNames[] = {"si", "cgs", "mm-g-ms"};
constexpr const char* kWholeSurface = "all";  // a surface patch has no faces to choose from

Face read_volume_face(const YamlMap& surfaces, const std::string& name) {
  const std::string word = surfaces.word(name);
  try {
    return face_from_name(word);
  } catch (const std::invalid_argument& error) {
    surfaces.fail(name, fmt::format("surfaces.{}: {}", name, error.what()));
  }
}

void expect_whole_surface(const YamlMap& surfaces, const std::string& name) {
  const std::string word = surfaces.word(name);
  if (word != kWholeSurface)
    surfaces.fail(name, fmt::format("surfaces.{}: unknown face '{}' of a surface patch, expected {}", name,
                                    word, kWholeSurface));
}

std::optional<Face> read_face(const YamlMap& surfaces, const std::string& name, bool volume) {
  if (volume) return read_volume_face(surfaces, name);
  expect_whole_surface(surfaces, name);
  return std::nullopt;
}

}  // namespace

const char* units_name(Units units) { return kUnitsNames[static_cast<int>(units)]; }

GeometryFile read_geometry(const YamlMap& document) {
  const std::string word = document.word_of("units", {kUnitsNames[0], kUnitsNames[1], kUnitsNames[2]});
  const auto units =
      std::find(std::begin(kUnitsNames), std::end(kUnitsNames), word) - std::begin(kUnitsNames);
  GeometryFile geometry{static_cast<Units>(units), read_shape(document.map("geometry")), {}};
  if (!document.has("surfaces")) return geometry;

  const YamlMap surfaces = document.map("surfaces");
  const bool volume = std::holds_alternative<Volume>(geometry.patch);
  for (const std::string& name : surfaces.keys())
    if (!geometry.surfaces.emplace(name, read_face(surfaces, name, volume)).second)
      surfaces.fail(name, fmt::format("surface '{}' is given twice, expected once", name));
  return geometry;
}

GeometryFile parse_geometry_file(const std::string& text, const std::string& file) {
  const YamlMap document = YamlMap::parse(text, file);
  document.allow_only({"units", "geometry", "surfaces"});
  return read_geometry(document);
}

NamedSurface named_surface(const GeometryFile& geometry, const std::string& name, const std::string& file) {
  const auto found = geometry.surfaces.find(name);
  if (found == geometry.surfaces.end()) {
    std::vector<std::string> names;
    for (const auto& surface : geometry.surfaces) names.push_back(surface.first);
    throw InputError(
        fmt::format("{}: unknown surface '{}', expected one of: {}", file, name,
                    names.empty() ? "(the file names none)" : fmt::format("{}", fmt::join(names, ", "))));
  }
  if (!found->second) return {std::get<Surface>(geometry.patch), 0};

  const Volume& volume = std::get<Volume>(geometry.patch);
  BoundarySurface face = boundary_surface(volume.space, *found->second);
  NodalVectors control_points(3, face.space.control_point_count());
  for (int a = 0; a < face.space.control_point_count(); ++a)
    control_points.col(a) = volume.control_points.col(face.volume_control_point[a]);
  return {{std::move(face.space), std::move(control_points)}, face.outward_sign};
}

}  // namespace nurbs
