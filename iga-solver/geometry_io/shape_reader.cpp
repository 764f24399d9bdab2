// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/shape_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <new>

#include "geometry_io/shape_changes.h"
#include "geometry_io/shape_limits.h"
#include "nurbs/primitives.h"

namespace geometry_io {

using nurbs::Curve;
using nurbs::Frame;
using nurbs::KnotVector;
using nurbs::max_degree;
using nurbs::NodalVectors;
using nurbs::Patch;
using nurbs::Space;
using nurbs::Strip;
using nurbs::Vector3;

namespace {

// The key that gives the elements.
const char* mesh_key(const YamlMap& map) { return map.has("breaks") ? "breaks" : "elements"; }

// `degree`: one number for all directions or one for each.
std::vector<int> read_degrees(const YamlMap& map, int dim) {
  if (!map.is_list("degree")) return std::vector<int>(dim, map.integer("degree", 1, max_degree(dim)));
  const std::vector<int> degrees = map.integers("degree", 1, max_degree(dim));
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
    const std::vector<int> elements = map.integers("elements", 1, shape_limits().elements);
    expect_count(map, "elements", elements.size(), dim);
    expect_size(map, mesh_key(map), elements, degrees);
    for (int d = 0; d < dim; ++d) knots.push_back(KnotVector::uniform(degrees[d], elements[d]));
  } else {
    const std::vector<std::vector<double>> breaks = map.table("breaks");
    expect_count(map, "breaks", breaks.size(), dim);
    std::vector<int> elements;
    for (const std::vector<double>& ends : breaks)
      elements.push_back(std::max(static_cast<int>(ends.size()), 1) - 1);
    expect_size(map, mesh_key(map), elements, degrees);
    for (int d = 0; d < dim; ++d) knots.push_back(knots_from_breaks(map, degrees[d], breaks[d], d));
  }
  return knots;
}

Shape read_box(const YamlMap& map) {
  const std::vector<KnotVector> knots = read_mesh(map, 3);
  const Vector3 origin = map.vector3("origin"), size = map.vector3("size");
  return blame(map, "size", "", [&] { return nurbs::box(origin, size, {knots[0], knots[1], knots[2]}); });
}

// `thickness` of a strip: a number, or [from, to] of a ramp.
Strip read_strip(const YamlMap& map) {
  map.allow_only({"length", "thickness", "elements"});
  Strip strip{map.number("length", positive()), {}, map.integer("elements", 1, shape_limits().elements)};
  if (map.is_list("thickness")) {
    const std::vector<double> ends = map.numbers("thickness");
    expect_count(map, "thickness", ends.size(), 2);
    strip.thickness = {ends[0], ends[1]};
  } else {
    strip.thickness.fill(map.number("thickness", positive()));
  }
  return strip;
}

Shape read_rolled_plate(const YamlMap& map) {
  const std::vector<int> degrees = read_degrees(map, 3),
                         elements = map.integers("elements", 1, shape_limits().elements);
  expect_count(map, "elements", elements.size(), 2);
  std::vector<Strip> strips;
  std::vector<int> sizes{0, elements[0], elements[1]};
  for (const YamlMap& strip : map.list_of_maps("strips")) {
    strips.push_back(read_strip(strip));
    sizes[0] += std::min(strips.back().elements, std::numeric_limits<int>::max() - sizes[0]);
  }
  expect_size(map, "elements", sizes, degrees);
  const Vector3 origin = map.vector3("origin");
  const double width = map.number("width", positive());
  return blame(map, "strips", "", [&] {
    return nurbs::rolled_plate(
        origin, width, strips, degrees[0],
        {KnotVector::uniform(degrees[1], elements[0]), KnotVector::uniform(degrees[2], elements[1])});
  });
}

Shape read_plane(const YamlMap& map) {
  const std::vector<KnotVector> knots = read_mesh(map, 2);
  const Vector3 origin = map.vector3("origin");
  const std::vector<std::vector<double>> edges = map.table("edges");
  expect_count(map, "edges", edges.size(), 2);
  for (const std::vector<double>& edge : edges)
    if (edge.size() != 3) map.fail("edges", fmt::format("edge of {} numbers, expected 3", edge.size()));
  return blame(map, "edges", "", [&] {
    return nurbs::plane(origin, Vector3(edges[0].data()), Vector3(edges[1].data()), {knots[0], knots[1]});
  });
}

// `elements` and `degree` of a round shape; quadratic unless said.
struct RoundMesh {
  std::vector<int> elements, degrees;

  KnotVector knots(int direction) const {
    return KnotVector::uniform(degrees[direction], elements[direction]);
  }
};

RoundMesh read_round_mesh(const YamlMap& map, int dim) {
  RoundMesh mesh{map.integers("elements", 1, shape_limits().elements), std::vector<int>(dim, 2)};
  expect_count(map, "elements", mesh.elements.size(), dim);
  if (map.has("degree")) mesh.degrees = read_degrees(map, dim);
  // the arcs of a whole turn add a control point per joint and degree
  expect_size(map, "elements", mesh.elements, std::vector<int>(dim, 4 * max_degree(dim)));
  return mesh;
}

// `key` holds [from, to] in degrees; `whole` where it is missing.
Curve read_arc(const YamlMap& map, const std::string& key, const std::vector<double>& whole,
               const RoundMesh& mesh, int direction) {
  const std::vector<double> angles = map.has(key) ? map.numbers(key) : whole;
  expect_count(map, key, angles.size(), 2);
  const int degree = mesh.degrees[direction];
  if (degree < 2)
    map.fail("degree", fmt::format("degree of an arc is {}, expected 2 to {}", degree,
                                   max_degree(static_cast<int>(mesh.degrees.size()))));
  const Curve quarters = blame(map, key, key + ": ", [&] { return nurbs::arc(angles[0], angles[1]); });
  return blame(map, "elements", key + ": ",
               [&] { return refined(quarters, mesh.elements[direction], degree); });
}

Curve read_turn(const YamlMap& map, const std::string& key, const RoundMesh& mesh, int direction) {
  return read_arc(map, key, {0.0, 360.0}, mesh, direction);
}

// The point under `origin`, the `axis`, and the `reference` direction if there is one.
Frame read_frame(const YamlMap& map, const std::string& origin, const Vector3& axis) {
  const Vector3 point = map.vector3(origin);
  const Frame placed = blame(map, "axis", "", [&] { return nurbs::frame(point, axis); });
  if (!map.has("reference")) return placed;
  return blame(map, "reference", "", [&] { return nurbs::frame(point, axis, map.vector3("reference")); });
}

Shape read_cylinder(const YamlMap& map) {
  const RoundMesh mesh = read_round_mesh(map, 2);
  return cylinder(read_frame(map, "origin", map.vector3("axis")), map.number("radius", positive()),
                  map.number("length", positive()), read_turn(map, "angle", mesh, 0), mesh.knots(1));
}

Shape read_cone(const YamlMap& map) {
  const RoundMesh mesh = read_round_mesh(map, 2);
  const Frame place = read_frame(map, "origin", map.vector3("axis"));
  const std::vector<double> radii = map.numbers("radii");
  expect_count(map, "radii", radii.size(), 2);
  const double length = map.number("length", positive());
  const Curve turn = read_turn(map, "angle", mesh, 0);
  return blame(map, "radii", "", [&] {
    return cone(place, {radii[0], radii[1]}, length, turn, mesh.knots(1));
  });
}

Shape read_sphere(const YamlMap& map) {
  const RoundMesh mesh = read_round_mesh(map, 2);
  const Frame place =
      read_frame(map, "centre", map.has("axis") ? map.vector3("axis") : Vector3(Vector3::UnitZ()));
  const double radius = map.number("radius", positive());
  const Curve longitude = read_turn(map, "longitude", mesh, 0);
  const Curve latitude = read_arc(map, "latitude", {-90.0, 90.0}, mesh, 1);
  return blame(map, "latitude", "", [&] { return sphere(place, radius, longitude, latitude); });
}

Shape read_torus(const YamlMap& map) {
  const RoundMesh mesh = read_round_mesh(map, 2);
  const Frame place = read_frame(map, "centre", map.vector3("axis"));
  const double radius = map.number("radius", positive()), tube = map.number("tube_radius", positive());
  const Curve azimuth = read_turn(map, "angle", mesh, 0), around = read_turn(map, "tube_angle", mesh, 1);
  return blame(map, "radius", "", [&] { return torus(place, radius, tube, azimuth, around); });
}

Shape read_tube(const YamlMap& map) {
  const RoundMesh mesh = read_round_mesh(map, 3);
  const Frame place = read_frame(map, "origin", map.vector3("axis"));
  const double inner = map.number("inner_radius", positive()), outer = map.number("outer_radius", positive());
  const double length = map.number("length", positive());
  const Curve turn = read_turn(map, "angle", mesh, 0);
  return blame(map, "outer_radius", "", [&] {
    return tube(place, inner, outer, length, turn, {mesh.knots(1), mesh.knots(2)});
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
  const std::vector<int> degrees = map.integers("degrees", 1, max_degree(Dim));
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

Shape read_patch(const YamlMap& patch) {
  patch.allow_only({"degrees", "knots", "control_points", "weights"});
  const size_t dim = patch.integers("degrees", 1, nurbs::kMaxDegree).size();
  if (dim == 2) return read_patch<2>(patch, std::make_index_sequence<2>());
  if (dim == 3) return read_patch<3>(patch, std::make_index_sequence<3>());
  patch.fail("degrees", fmt::format("degrees is a list of {}, expected 2 (a surface) or 3 (a volume)", dim));
}

std::vector<Shape> read_patches(const YamlMap& geometry) {
  std::vector<Shape> patches;
  for (const YamlMap& patch : geometry.list_of_maps("patches")) patches.push_back(read_patch(patch));
  if (patches.empty()) geometry.fail("patches", "patches is empty, expected one patch at least");
  return patches;
}

/// A word under `geometry`, the keys under it, and their reader.
struct ShapeKey {
  const char* key;
  std::vector<std::string> keys;
  Shape (*read)(const YamlMap&);
};

const std::vector<ShapeKey>& shape_table() {
  static const std::vector<std::string> kRound = {"axis", "reference", "elements", "degree"};
  const auto round = [](std::vector<std::string> keys) {
    keys.insert(keys.end(), kRound.begin(), kRound.end());
    return keys;
  };
  static const std::vector<ShapeKey> kShapes = {
      {"box", {"origin", "size", "elements", "breaks", "degree"}, read_box},
      {"rolled_plate", {"origin", "width", "strips", "elements", "degree"}, read_rolled_plate},
      {"plane", {"origin", "edges", "elements", "breaks", "degree"}, read_plane},
      {"cylinder", round({"origin", "radius", "length", "angle"}), read_cylinder},
      {"cone", round({"origin", "radii", "length", "angle"}), read_cone},
      {"sphere", round({"centre", "radius", "longitude", "latitude"}), read_sphere},
      {"torus", round({"centre", "radius", "tube_radius", "angle", "tube_angle"}), read_torus},
      {"tube", round({"origin", "inner_radius", "outer_radius", "length", "angle"}), read_tube},
  };
  return kShapes;
}

Shape read_sized(const ShapeKey& shape, const YamlMap& map) {
  try {
    map.allow_only(shape.keys);
    return shape.read(map);
  } catch (const std::bad_alloc&) {
    const std::string key = mesh_key(map);
    const bool sizes = key == "elements" && map.is_list(key);
    map.fail(key, fmt::format("{}: no memory for a {} of {} elements", key, shape.key,
                              sizes ? fmt::format("{}", fmt::join(map.words(key), " x ")) : "so many"));
  }
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  for (const ShapeKey& shape : shape_table()) keys.emplace_back(shape.key);
  keys.insert(keys.end(), {"patches", "shapes", "file"});
  return keys;
}

}  // namespace

std::vector<ShapeWords> shape_words() {
  std::vector<ShapeWords> words;
  for (const ShapeKey& shape : shape_table()) words.push_back({shape.key, shape.keys});
  return words;
}

void expect_one_shape(const YamlMap& geometry) {
  const std::vector<std::string> known = all_keys();
  std::vector<std::string> allowed = known;
  allowed.insert(allowed.end(), change_words().begin(), change_words().end());
  geometry.allow_only(allowed);
  const auto given =
      std::count_if(known.begin(), known.end(), [&](const auto& key) { return geometry.has(key); });
  if (given != 1)
    geometry.fail("geometry",
                  fmt::format("{} geometries given, expected one of: {}", given, fmt::join(known, ", ")));
}

std::vector<Shape> read_shapes(const YamlMap& geometry) {
  for (const ShapeKey& shape : shape_table())
    if (geometry.has(shape.key)) {
      std::vector<Shape> shapes;  // a list in braces would be copied
      shapes.push_back(read_sized(shape, geometry.map(shape.key)));
      return shapes;
    }
  return read_patches(geometry);
}

}  // namespace geometry_io
