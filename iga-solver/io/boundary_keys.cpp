// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/boundary_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/time_keys.h"

namespace io {

using geometry_io::GeometryFile;
using geometry_io::YamlMap;

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

structure::Directions read_directions(const YamlMap& map) {
  structure::Directions directions{false, false, false};
  for (const std::string& word : map.words("fix")) {
    if (word != "x" && word != "y" && word != "z")
      map.fail("fix", fmt::format("fix has '{}', expected a list of x, y, z", word));
    directions[word[0] - 'x'] = true;
  }
  return directions;
}

/// The axis along the normal of an axis-parallel plane face, which is where its control points lie.
structure::Directions read_symmetry(const YamlMap& map, const nurbs::Volume& patch, nurbs::Face face) {
  constexpr double kFlat = 1e-9;
  const nurbs::NodalVectors X = patch.control_points(Eigen::all, structure::nodes_on(patch.space, {face}));
  const Vector3 extent = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
  structure::Directions normal;
  for (int i = 0; i < 3; ++i) normal[i] = extent[i] <= kFlat * extent.maxCoeff();
  if (std::count(normal.begin(), normal.end(), true) != 1)
    map.fail("symmetry",
             fmt::format("symmetry has {}, which extends by {:.6g}, {:.6g}, {:.6g} along x, y, z, "
                         "expected a plane face across one of them",
                         map.word("symmetry"), extent[0], extent[1], extent[2]));
  return normal;
}

void read_motion(const YamlMap& entry, BoundaryEntry& support) {
  const YamlMap map = entry.map("move");
  map.allow_only({"x", "y", "z"});
  support.moves = true;
  for (int i = 0; i < 3; ++i) {
    support.directions[i] = map.has(kAxes[i]);
    if (support.directions[i]) support.displacement[i] = map.number(kAxes[i]);
  }
  support.time = read_time_function(entry);
}

BoundaryEntry read_entry(const YamlMap& map, const GeometryFile& geometry,
                         const structure::NodeNumbering& nodes) {
  BoundaryEntry entry{map.has("name") ? map.word("name") : "", {}, {false, false, false}};
  if (map.has("symmetry")) {
    map.allow_only({"name", "symmetry", "patch"});
    const int patch = read_patch(map, geometry);
    const nurbs::Face face = read_face(map, "symmetry");
    entry.directions = read_symmetry(map, std::get<nurbs::Volume>(geometry.patches[patch]), face);
    entry.where = {{patch}, {face}};
    entry.nodes = nodes_of(entry.where, geometry, nodes);
    return entry;
  }
  map.allow_only(with_selection_keys({"name", "fix", "symmetry", "move", "time"}));
  if (map.has("fix") == map.has("move"))
    map.fail(map.has("fix") ? "move" : "",
             fmt::format("{} of 'fix', 'move', 'symmetry', expected one", map.has("fix") ? "two" : "none"));
  if (map.has("fix") && map.has("time"))
    map.fail("time", "time is given for what is fixed, expected it with 'move'");
  if (map.has("fix"))
    entry.directions = read_directions(map);
  else
    read_motion(map, entry);
  entry.where = read_selection(map, geometry, nodes);
  entry.nodes = nodes_of(entry.where, geometry, nodes);
  return entry;
}

void hold(const BoundaryEntry& entry, structure::Supports& supports) {
  if (entry.moves)
    supports.move(entry.nodes, entry.directions, entry.displacement, entry.time);
  else
    supports.fix(entry.nodes, entry.directions);
}

}  // namespace

std::vector<BoundaryEntry> read_boundary(const std::vector<YamlMap>& entries, const GeometryFile& geometry,
                                         const structure::NodeNumbering& nodes) {
  std::vector<BoundaryEntry> boundary;
  for (const YamlMap& map : entries) {
    boundary.push_back(read_entry(map, geometry, nodes));
    for (std::size_t i = 0; i + 1 < boundary.size(); ++i)
      if (!boundary[i].name.empty() && boundary[i].name == boundary.back().name)
        map.fail("name", fmt::format("name '{}' is given twice, expected once", boundary[i].name));
  }
  return boundary;
}

structure::Supports supports_of(const std::vector<BoundaryEntry>& boundary) {
  structure::Supports supports;
  for (const BoundaryEntry& entry : boundary) hold(entry, supports);
  return supports;
}

std::vector<structure::NamedSupport> named_supports(const std::vector<BoundaryEntry>& boundary) {
  std::vector<structure::NamedSupport> named;
  structure::Supports all;
  std::vector<Eigen::Index> before;
  for (const BoundaryEntry& entry : boundary) {
    hold(entry, all);
    structure::NamedSupport support{entry.name, {}};
    std::set_difference(all.fixed_dofs().begin(), all.fixed_dofs().end(), before.begin(), before.end(),
                        std::back_inserter(support.dofs));
    before = all.fixed_dofs();
    if (!entry.name.empty()) named.push_back(std::move(support));
  }
  return named;
}

}  // namespace io
