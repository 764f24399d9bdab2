// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/geometry_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "nurbs/primitives.h"

namespace nurbs {
namespace {

constexpr const char* kUnitsNames[] = {"si", "cgs", "mm-g-ms"};
constexpr const char* kWholeSurface = "all";  // a surface patch has no faces to choose from
constexpr int kMaxElements = 1000000;         // per direction; guards against a slip of the finger

// Runs `build`; what it finds wrong with its arguments is an error of the file at `key`.
template <class Build>
auto blame(const YamlMap& map, const std::string& key, const std::string& prefix, Build build) {
  try {
    return build();
  } catch (const std::invalid_argument& error) {
    map.fail(key, prefix + error.what());
  }
}

void expect_count(const YamlMap& map, const std::string& key, size_t given, size_t expected) {
  if (given != expected) map.fail(key, fmt::format("{} is a list of {}, expected {}", key, given, expected));
}

// `degree`: one number for all directions or one for each.
std::vector<int> read_degrees(const YamlMap& map, int dim) {
  if (!map.is_list("degree")) return std::vector<int>(dim, map.integer("degree", 1, kMaxDegree));
  const std::vector<int> degrees = map.integers("degree", 1, kMaxDegree);
  expect_count(map, "degree", degrees.size(), dim);
  return degrees;
}

KnotVector knots_from_breaks(const YamlMap& map, int degree, const std::vector<double>& breaks,
                             int direction) {
  const std::string prefix = fmt::format("breaks of direction {}: ", direction + 1);
  if (breaks.empty() || breaks.front() != 0.0 || breaks.back() != 1.0)
    map.fail("breaks", prefix + fmt::format("[{}], expected a list from 0 to 1", fmt::join(breaks, ", ")));
  return blame(map, "breaks", prefix, [&] { return KnotVector::from_breaks(degree, breaks); });
}

// `degree` with `elements` (equal ones) or `breaks` (graded).
std::vector<KnotVector> read_mesh(const YamlMap& map, int dim) {
  const std::vector<int> degrees = read_degrees(map, dim);
  std::vector<KnotVector> knots;
  if (map.has("elements") == map.has("breaks"))
    map.fail("elements", "'elements' and 'breaks' are both given or both missing, expected one of them");
  if (map.has("elements")) {
    const std::vector<int> elements = map.integers("elements", 1, kMaxElements);
    expect_count(map, "elements", elements.size(), dim);
    for (int d = 0; d < dim; ++d) knots.push_back(KnotVector::uniform(degrees[d], elements[d]));
  } else {
    const std::vector<std::vector<double>> breaks = map.table("breaks");
    expect_count(map, "breaks", breaks.size(), dim);
    for (int d = 0; d < dim; ++d) knots.push_back(knots_from_breaks(map, degrees[d], breaks[d], d));
  }
  return knots;
}

Volume read_box(const YamlMap& map) {
  map.allow_only({"origin", "size", "elements", "breaks", "degree"});
  const std::vector<KnotVector> knots = read_mesh(map, 3);
  const Vector3 origin = map.vector3("origin"), size = map.vector3("size");
  return blame(map, "size", "", [&] { return box(origin, size, {knots[0], knots[1], knots[2]}); });
}

Surface read_plane(const YamlMap& map) {
  map.allow_only({"origin", "edges", "elements", "breaks", "degree"});
  const std::vector<KnotVector> knots = read_mesh(map, 2);
  const Vector3 origin = map.vector3("origin");
  const std::vector<std::vector<double>> edges = map.table("edges");
  expect_count(map, "edges", edges.size(), 2);
  for (const std::vector<double>& edge : edges)
    if (edge.size() != 3) map.fail("edges", fmt::format("edge of {} numbers, expected 3", edge.size()));
  return blame(map, "edges", "", [&] {
    return plane(origin, Vector3(edges[0].data()), Vector3(edges[1].data()), {knots[0], knots[1]});
  });
}

NodalVectors read_control_points(const YamlMap& map, int expected) {
  const std::vector<std::vector<double>> rows = map.table("control_points");
  if (static_cast<int>(rows.size()) != expected)
    map.fail("control_points", fmt::format("{} control points given, expected {}", rows.size(), expected));
  NodalVectors control_points(3, expected);
  for (int a = 0; a < expected; ++a) {
    if (rows[a].size() != 3)
      map.fail("control_points",
               fmt::format("control point {} has {} coordinates, expected 3", a + 1, rows[a].size()));
    control_points.col(a) = Vector3(rows[a].data());
  }
  return control_points;
}

template <int Dim, size_t... Direction>
Patch<Dim> read_patch(const YamlMap& map, std::index_sequence<Direction...>) {
  const std::vector<int> degrees = map.integers("degrees", 1, kMaxDegree);
  const std::vector<std::vector<double>> knots = map.table("knots");
  expect_count(map, "knots", knots.size(), Dim);
  const auto knot_vector = [&](size_t d) {
    const std::string prefix = fmt::format("knots of direction {}: ", d + 1);
    return blame(map, "knots", prefix, [&] { return KnotVector(degrees[d], knots[d]); });
  };
  const std::array<KnotVector, Dim> directions{knot_vector(Direction)...};
  const std::vector<double> weights = map.has("weights") ? map.numbers("weights") : std::vector<double>{};
  Space<Dim> space = blame(map, "weights", "", [&] { return Space<Dim>(directions, weights); });
  NodalVectors control_points = read_control_points(map, space.control_point_count());
  return {std::move(space), std::move(control_points)};
}

std::variant<Surface, Volume> read_patches(const YamlMap& geometry) {
  const std::vector<YamlMap> patches = geometry.list_of_maps("patches");
  if (patches.size() != 1)
    geometry.fail("patches", fmt::format("1 patch supported, {} given", patches.size()));
  const YamlMap& patch = patches.front();
  patch.allow_only({"degrees", "knots", "control_points", "weights"});
  const size_t dim = patch.integers("degrees", 1, kMaxDegree).size();
  if (dim == 2) return read_patch<2>(patch, std::make_index_sequence<2>());
  if (dim == 3) return read_patch<3>(patch, std::make_index_sequence<3>());
  patch.fail("degrees", fmt::format("degrees is a list of {}, expected 2 (a surface) or 3 (a volume)", dim));
}

std::variant<Surface, Volume> read_shape(const YamlMap& geometry) {
  geometry.allow_only({"box", "plane", "patches"});
  const size_t given = geometry.keys().size();
  if (given != 1)
    geometry.fail("geometry",
                  fmt::format("{} geometries given, expected one of: box, plane, patches", given));
  if (geometry.has("box")) return read_box(geometry.map("box"));
  if (geometry.has("plane")) return read_plane(geometry.map("plane"));
  return read_patches(geometry);
}

std::optional<Face> read_face(const YamlMap& surfaces, const std::string& name, bool volume) {
  const std::string word = surfaces.word(name);
  if (volume)
    return blame(surfaces, name, fmt::format("surfaces.{}: ", name), [&] { return face_from_name(word); });
  if (word != kWholeSurface)
    surfaces.fail(name, fmt::format("surfaces.{}: unknown face '{}' of a surface patch, expected {}", name,
                                    word, kWholeSurface));
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
