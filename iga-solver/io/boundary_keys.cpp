// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/boundary_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/output_keys.h"
#include "io/time_keys.h"
#include "structure/conditions/columns.h"
#include "structure/conditions/loads.h"

namespace io {

using geometry_io::GeometryFile;
using geometry_io::YamlMap;

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

structure::Directions read_directions(const YamlMap& map) {
  structure::Directions directions{false, false, false};
  if (!map.is_list("fix")) map.fail("fix", "fix is not a list, expected some of x, y, z: [x, y, z]");
  for (const std::string& word : map.some_words("fix", "x, y, z")) {
    if (word != "x" && word != "y" && word != "z")
      map.fail("fix", fmt::format("fix has '{}', expected a list of x, y, z", word));
    bool& fixed = directions[word[0] - 'x'];
    if (fixed) map.fail("fix", fmt::format("fix has '{}' twice, expected once", word));
    fixed = true;
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
  const YamlMap map = entry.map("move", "{z: 1e-3}");
  map.allow_only({"x", "y", "z"});
  if (map.keys().empty()) entry.fail("move", "move is empty, expected some of x, y, z: {z: 1e-3}");
  support.moves = true;
  for (int i = 0; i < 3; ++i) {
    support.directions[i] = map.has(kAxes[i]);
    if (support.directions[i]) support.displacement[i] = map.number(kAxes[i]);
  }
  support.time = read_time_function(entry);
}

/// k in all directions, or along one: k d d^T.
void read_spring(const YamlMap& entry, BoundaryEntry& support) {
  const YamlMap map = entry.map("spring", "{stiffness: 1e9}");
  map.allow_only({"stiffness", "direction", "per"});
  const double k = map.number("stiffness", geometry_io::positive());
  support.spring = k * structure::Stiffness3::Identity();
  if (map.has("direction")) {
    const Vector3 d = map.vector3("direction");
    if (!(d.norm() > 0.0)) map.fail("direction", "direction is [0, 0, 0], expected one");
    support.spring = k / d.squaredNorm() * d * d.transpose();
  }
  const bool on_faces = entry.has("faces");
  support.per_area = map.has("per") ? map.word_of("per", {"area", "node"}) == "area" : on_faces;
  if (support.per_area && !on_faces)
    map.fail("per", "per is area, expected 'faces' to have one, or per: node");
}

BoundaryEntry read_entry(const YamlMap& map, const GeometryFile& geometry,
                         const structure::NodeNumbering& nodes) {
  BoundaryEntry entry{map.has("name") ? map.word("name") : "", {}, {false, false, false}};
  if (map.has("symmetry")) {
    map.allow_only({"name", "symmetry", "patch"});
    const int patch = read_patch(map, geometry);
    const nurbs::Face face = read_face(map, "symmetry");
    entry.directions = read_symmetry(map, std::get<nurbs::Volume>(geometry.patches[patch]), face);
    entry.is_symmetry = true;
    entry.where = {{patch}, {face}};
    entry.nodes = nodes_of(entry.where, geometry, nodes);
    return entry;
  }
  map.allow_only(with_selection_keys({"name", "fix", "symmetry", "move", "spring", "time"}));
  const int kinds = int(map.has("fix")) + int(map.has("move")) + int(map.has("spring"));
  if (kinds != 1) map.fail("", fmt::format("{} of 'fix', 'move', 'spring', 'symmetry', expected one", kinds));
  if (map.has("time") && !map.has("move"))
    map.fail("time", "time is given for what does not move, expected it with 'move'");
  if (map.has("fix")) entry.directions = read_directions(map);
  if (map.has("move")) read_motion(map, entry);
  if (map.has("spring")) read_spring(map, entry);
  entry.where = read_selection(map, geometry, nodes);
  entry.nodes = nodes_of(entry.where, geometry, nodes);
  return entry;
}

void hold(const BoundaryEntry& entry, structure::Supports& supports) {
  if (entry.moves)
    supports.move(entry.nodes, entry.directions, entry.displacement, entry.time);
  else if (!entry.spring)
    supports.fix(entry.nodes, entry.directions);
}

}  // namespace

std::vector<BoundaryEntry> read_boundary(const std::vector<YamlMap>& entries, const GeometryFile& geometry,
                                         const structure::NodeNumbering& nodes) {
  std::vector<BoundaryEntry> boundary;
  for (const YamlMap& map : entries) {
    boundary.push_back(read_entry(map, geometry, nodes));
    expect_series_name(map, "name", boundary.back().name);
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

structure::Springs springs_of(const std::vector<BoundaryEntry>& boundary, const GeometryFile& geometry,
                              const structure::NodeNumbering& nodes, const std::vector<structure::Id>& ids) {
  structure::Springs springs;
  const structure::Columns columns(ids);
  for (const BoundaryEntry& entry : boundary) {
    if (!entry.spring) continue;
    std::vector<structure::Springs::Spring> group;
    const auto add = [&](structure::Id node, double share) {
      if (const std::ptrdiff_t column = columns.of(node); column >= 0)
        group.push_back({column, share * *entry.spring});
    };
    if (entry.per_area)
      for (const int patch : entry.where.patches)
        for (const nurbs::Face face : entry.where.faces)
          for (const auto& [node, area] : skin_areas(skin_of(geometry, nodes, {patch, face})))
            add(node, area);
    else
      for (const int node : entry.nodes) add(node, 1.0);
    springs.add(std::move(group));
  }
  return springs;
}

std::vector<structure::NamedSupport> named_supports(const std::vector<BoundaryEntry>& boundary) {
  std::vector<structure::NamedSupport> named;
  structure::Supports all;
  std::vector<Eigen::Index> before;
  std::size_t springs = 0;
  for (const BoundaryEntry& entry : boundary) {
    hold(entry, all);
    structure::NamedSupport support{entry.name, {}};
    if (entry.spring) support.spring_group = springs++;
    std::set_difference(all.fixed_dofs().begin(), all.fixed_dofs().end(), before.begin(), before.end(),
                        std::back_inserter(support.dofs));
    before = all.fixed_dofs();
    if (!entry.name.empty()) named.push_back(std::move(support));
  }
  return named;
}

}  // namespace io
