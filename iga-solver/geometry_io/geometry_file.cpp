// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/geometry_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>

#include "geometry_io/cad_placement.h"
#include "geometry_io/cad_selection.h"
#include "geometry_io/shape_changes.h"
#include "geometry_io/shape_reader.h"
#include "geometry_io/wall_size.h"

namespace geometry_io {
namespace {

constexpr std::initializer_list<const char*> kUnitsNames = {"si", "cgs", "mm-g-ms", "mm-t-s"};

std::vector<std::string> words_of(const YamlMap& surfaces, const std::string& name) {
  return surfaces.is_list(name) ? surfaces.words(name) : std::vector<std::string>{surfaces.word(name)};
}

std::vector<SurfacePiece> read_surface(const YamlMap& surfaces, const std::string& name,
                                       const std::vector<Shape>& patches) {
  try {
    return parse_surface(words_of(surfaces, name), patches);
  } catch (const std::invalid_argument& error) {
    surfaces.fail(name, fmt::format("surfaces.{}: {}", name, error.what()));
  }
}

std::vector<int> read_cad_surface(const YamlMap& surfaces, const std::string& name,
                                  const brep::CadModel& cad) {
  try {
    return cad_faces(cad, words_of(surfaces, name));
  } catch (const std::invalid_argument& error) {
    surfaces.fail(name, fmt::format("surfaces.{}: {}", name, error.what()));
  }
}

GeometryFile open_other_file(const YamlMap& geometry, Units units, const OpenGeometry& open) {
  const std::string file = geometry.word("file");
  if (!open)
    geometry.fail("file", fmt::format("geometry.file is {} in a file that is itself read for another one, "
                                      "expected the shapes here",
                                      file));
  return open((std::filesystem::path(geometry.file()).parent_path() / file).string(), units);
}

GeometryFile read_changed(const YamlMap& map, Units units, const OpenGeometry& open);

/// `shapes`, patch after patch; surfaces that files among them name stay named.
GeometryFile read_several(const YamlMap& geometry, Units units, const OpenGeometry& open) {
  GeometryFile all{units, {}, {}};
  std::vector<SurfacePiece> said_all;  // of files that offer it, such as STL
  for (const YamlMap& map : geometry.list_of_maps("shapes")) {
    GeometryFile part = read_changed(map, units, open);
    if (part.cad) map.fail("file", "a CAD file among shapes, expected it alone, as geometry: {file: NAME}");
    for (auto& [name, pieces] : part.surfaces) {
      for (SurfacePiece& piece : pieces) piece.patch += static_cast<int>(all.patches.size());
      if (name == kAllPatches && pieces.size() == part.patches.size())
        said_all.insert(said_all.end(), pieces.begin(), pieces.end());
      else if (!all.surfaces.emplace(name, pieces).second)
        map.fail("file", fmt::format("surface '{}' is named by two files, expected one", name));
    }
    for (const int patch : part.from_words)
      all.from_words.insert(patch + static_cast<int>(all.patches.size()));
    all.patches.insert(all.patches.end(), part.patches.begin(), part.patches.end());
  }
  if (all.patches.empty()) geometry.fail("shapes", "shapes is empty, expected one shape at least");
  if (!said_all.empty())
    all.surfaces[kAllPatches] = std::any_of(all.patches.begin(), all.patches.end(), is_volume)
                                    ? said_all
                                    : parse_surface({kAllPatches}, all.patches);
  return all;
}

void change_cad(const YamlMap& map, const Placement& change, GeometryFile& geometry) {
  if (map.has("refine")) map.fail("refine", "refine of a CAD file, expected scale, rotate or move");
  if (change.matrix() == Placement::Identity().matrix()) return;
  brep::CadModel model = *geometry.cad;
  try {
    place(model, change);
  } catch (const std::invalid_argument& error) {
    map.fail("scale", error.what());
  }
  geometry.cad = std::make_shared<const brep::CadModel>(std::move(model));
}

GeometryFile read_changed(const YamlMap& map, Units units, const OpenGeometry& open) {
  expect_one_shape(map);
  GeometryFile geometry = map.has("file")     ? open_other_file(map, units, open)
                          : map.has("shapes") ? read_several(map, units, open)
                                              : GeometryFile{units, read_shapes(map), {}};
  if (!map.has("file") && !map.has("shapes") && !map.has("patches")) geometry.from_words = {0};
  expect_scaled_size(map, extents_of(geometry.patches, geometry.cad.get()));
  const Placement change = change_shapes(map, geometry.patches);
  if (geometry.cad) change_cad(map, change, geometry);
  return geometry;
}

// YAML's keys are different ones: what has the name already is a file that `geometry` names.
[[noreturn]] void refuse_name(const YamlMap& document, const GeometryFile& geometry,
                              const std::string& name) {
  const YamlMap shapes = document.map("geometry");
  const int patch = geometry.surfaces.at(name).front().patch;
  const auto* mesh = std::get_if<TriangleMesh>(&geometry.patches[patch]);
  document.map("surfaces")
      .fail(name, fmt::format("surface '{}': {} has a {} of that name already, expected another name", name,
                              shapes.has("file") ? shapes.word("file") : "a file among its shapes",
                              mesh != nullptr && mesh->name == name ? "solid" : "surface"));
}

}  // namespace

const char* units_name(Units units) { return kUnitsNames.begin()[static_cast<int>(units)]; }

Units units_from_name(const std::string& name) {
  for (const Units units : {Units::si, Units::cgs, Units::mm_g_ms, Units::mm_t_s})
    if (name == units_name(units)) return units;
  throw std::invalid_argument(
      fmt::format("units is '{}', expected one of: {}", name, fmt::join(kUnitsNames, ", ")));
}

GeometryFile read_geometry(const YamlMap& document, const OpenGeometry& open) {
  const Units units = units_from_name(document.word_of("units", kUnitsNames));
  GeometryFile geometry = read_changed(document.map("geometry"), units, open);
  if (!document.has("surfaces")) return geometry;

  const YamlMap surfaces = document.map("surfaces");
  for (const std::string& name : surfaces.keys())
    if (geometry.cad)
      geometry.cad_surfaces[name] = read_cad_surface(surfaces, name, *geometry.cad);
    else if (!geometry.surfaces.emplace(name, read_surface(surfaces, name, geometry.patches)).second)
      refuse_name(document, geometry, name);
  return geometry;
}

GeometryFile parse_geometry_file(const std::string& text, const std::string& file, const OpenGeometry& open) {
  const YamlMap document = YamlMap::parse(text, file);
  document.allow_only({"units", "geometry", "surfaces"});
  return read_geometry(document, open);
}

const std::vector<SurfacePiece>& pieces_of(const GeometryFile& geometry, const std::string& name,
                                           const std::string& file) {
  if (geometry.cad)
    throw InputError(fmt::format(
        "{}: surface '{}' is of a CAD file, whose faces are no patches, expected NURBS patches or triangles",
        file, name));
  const auto found = geometry.surfaces.find(name);
  if (found != geometry.surfaces.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& surface : geometry.surfaces) names.push_back(surface.first);
  throw InputError(
      fmt::format("{}: unknown surface '{}', expected one of: {}", file, name,
                  names.empty() ? "(the file names none)" : fmt::format("{}", fmt::join(names, ", "))));
}

JoinedMesh joined_triangles(const GeometryFile& geometry, const std::vector<SurfacePiece>& pieces) {
  std::vector<const TriangleMesh*> meshes;
  std::vector<int> patch;
  for (const SurfacePiece& piece : pieces)
    if (const auto* mesh = std::get_if<TriangleMesh>(&geometry.patches[piece.patch])) {
      meshes.push_back(mesh);
      patch.push_back(piece.patch);
    }
  JoinedMesh all = joined(meshes);
  for (int& part : all.part) part = patch[part];
  return all;
}

JoinedMesh named_triangles(const GeometryFile& geometry, const std::string& name, const std::string& file) {
  const std::vector<SurfacePiece>& pieces = pieces_of(geometry, name, file);
  JoinedMesh all = joined_triangles(geometry, pieces);
  if (all.mesh.degenerate > 0 && all.mesh.triangles.empty())
    throw InputError(fmt::format(
        "{}: no triangle of surface '{}' has three different corners, expected one at least", file, name));
  return all;
}

std::vector<OrientedSurface> named_surface(const GeometryFile& geometry, const std::string& name,
                                           const std::string& file) {
  std::vector<OrientedSurface> patches;
  for (const SurfacePiece& piece : pieces_of(geometry, name, file)) {
    if (is_triangles(geometry.patches[piece.patch]))
      throw InputError(fmt::format(
          "{}: surface '{}' is of triangles (STL), expected NURBS patches: triangles are a wall of "
          "LIGGGHTS' own, 'fix mesh/surface' with 'fix wall/gran ... mesh'",
          file, name));
    patches.push_back(extract(piece, geometry.patches));
    patches.back().from_words = geometry.from_words.count(piece.patch) > 0;
  }
  return patches;
}

std::vector<int> named_cad_faces(const GeometryFile& geometry, const std::string& name,
                                 const std::string& file) {
  const auto found = geometry.cad_surfaces.find(name);
  if (found != geometry.cad_surfaces.end()) return found->second;
  try {
    return cad_faces(*geometry.cad, {name});
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
}

}  // namespace geometry_io
