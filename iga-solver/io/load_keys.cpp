// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/load_keys.h"

#include <fmt/format.h>

#include <stdexcept>

#include "io/time_keys.h"

namespace io {

using geometry_io::GeometryFile;
using geometry_io::YamlMap;

namespace {

const std::vector<std::string> kOfPlaceAndTime = {"x", "y", "z", "t"}, kOfPlace = {"x", "y", "z"};

Gravity read_gravity(const YamlMap& loads) {
  if (loads.is_list("gravity")) return {loads.vector3("gravity")};
  if (loads.is_map("gravity")) {
    const YamlMap map = loads.map("gravity");
    map.allow_only({"value", "time"});
    return {map.vector3("value"), false, read_time_function(map)};
  }
  if (loads.word("gravity") != "deck")
    loads.fail("gravity",
               fmt::format("gravity is '{}', expected [x, y, z], {{value: [x, y, z], time: ...}} or "
                           "deck",
                           geometry_io::shown(loads.word("gravity"))));
  return {Vector3::Zero(), true};
}

FaceLoad read_face_load(const YamlMap& map, const GeometryFile& geometry, bool is_pressure) {
  map.allow_only({"face", "patch", "value", "time"});
  return {{read_patch(map, geometry), read_face(map, "face")},
          is_pressure ? read_scalar_field(map, "value", kOfPlaceAndTime)
                      : read_field(map, "value", kOfPlaceAndTime),
          read_time_function(map)};
}

LineLoad read_line_load(const YamlMap& map, const GeometryFile& geometry,
                        const structure::NodeNumbering& nodes) {
  map.allow_only({"edge", "patch", "value", "time"});
  const Selection edge = read_selection(map, geometry, nodes);
  if (!map.has("edge")) map.fail("", "edge is missing");
  return {read_patch(map, geometry),  // one alone
          {edge.faces[0], edge.faces[1]},
          read_field(map, "value", kOfPlace),
          read_time_function(map)};
}

PointLoad read_point_load(const YamlMap& map, const GeometryFile& geometry,
                          const structure::NodeNumbering& nodes) {
  map.allow_only({"face", "at", "patch", "force", "time"});
  const int patch = read_patch(map, geometry);
  const nurbs::Space<3>& space = std::get<nurbs::Volume>(geometry.patches[patch]).space;
  const nurbs::Face face = read_face(map, "face");
  const std::vector<double> at = map.numbers("at");
  if (at.size() != 2) map.fail("at", fmt::format("at has {} numbers, expected 2 from 0 to 1", at.size()));
  try {
    structure::Probe point =
        structure::probe_at("", space, structure::face_point(space, face, {at[0], at[1]}));
    for (int& node : point.nodes) node = static_cast<int>(nodes.node(patch, node));
    return {std::move(point), map.vector3("force"), read_time_function(map)};
  } catch (const std::invalid_argument&) {
    map.fail("at", fmt::format("at is [{}, {}], expected 2 numbers from 0 to 1", at[0], at[1]));
  }
}

/// read(entry) for each of a list.
template <class Read>
auto read_each(const YamlMap& map, const std::string& key, Read read) {
  std::vector<decltype(read(map))> entries;
  if (map.has(key))
    for (const YamlMap& entry : map.list_of_maps(key)) entries.push_back(read(entry));
  return entries;
}

}  // namespace

Loads read_loads(const YamlMap& map, const GeometryFile& geometry, const structure::NodeNumbering& nodes) {
  map.allow_only({"gravity", "tractions", "pressures", "lines", "points", "body_force"});
  Loads loads;
  if (map.has("gravity")) loads.gravity = read_gravity(map);
  loads.tractions =
      read_each(map, "tractions", [&](const YamlMap& m) { return read_face_load(m, geometry, false); });
  loads.pressures =
      read_each(map, "pressures", [&](const YamlMap& m) { return read_face_load(m, geometry, true); });
  loads.lines = read_each(map, "lines", [&](const YamlMap& m) { return read_line_load(m, geometry, nodes); });
  loads.points =
      read_each(map, "points", [&](const YamlMap& m) { return read_point_load(m, geometry, nodes); });
  if (map.has("body_force")) {
    const YamlMap force = map.map("body_force");
    force.allow_only({"value", "time"});
    loads.body_force = {read_field(force, "value", kOfPlace), read_time_function(force)};
  }
  return loads;
}

FieldKey read_initial_velocity(const YamlMap& map) {
  map.allow_only({"velocity"});
  return read_field(map, "velocity", kOfPlace);
}

}  // namespace io
