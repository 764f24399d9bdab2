// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "geometry_io/wall_size.h"

namespace io {

using geometry_io::GeometryFile;
using geometry_io::YamlMap;
using structure::NodeSet;

namespace {

nurbs::Face face_of(const YamlMap& map, const std::string& key, const std::string& name) {
  try {
    return nurbs::face_from_name(name);
  } catch (const std::invalid_argument& error) {
    map.fail(key, error.what());
  }
}

std::vector<nurbs::Face> read_faces(const YamlMap& map, const std::string& key) {
  std::vector<nurbs::Face> faces;
  for (const std::string& name : map.some_words(key, "xi-, xi+, eta-, eta+, zeta-, zeta+"))
    faces.push_back(face_of(map, key, name));
  return faces;
}

template <class Value>
typename std::vector<Value>::const_iterator first_repeated(const std::vector<Value>& values) {
  return std::find_if(values.begin(), values.end(), [&](const Value& value) {
    return std::count(values.begin(), values.end(), value) > 1;
  });
}

/// Control points of a patch.
NodeSet points_of_patch(const Selection& selection, const nurbs::Volume& patch) {
  if (selection.box)
    return structure::nodes_within(patch.control_points, (*selection.box)[0], (*selection.box)[1]);
  if (selection.on_all_of_them) return structure::nodes_on(patch.space, selection.faces);
  NodeSet all;
  for (const nurbs::Face face : selection.faces) {
    const NodeSet one = structure::nodes_on(patch.space, {face}), before = std::exchange(all, {});
    std::set_union(before.begin(), before.end(), one.begin(), one.end(), std::back_inserter(all));
  }
  return all;
}

/// Larger by the round-off of control points that are meant to stand on its borders.
std::array<Vector3, 2> read_box(const YamlMap& map, const GeometryFile& geometry) {
  constexpr double kSame = 1e-9;  // of the body's size, as of welds
  const std::vector<std::vector<double>> rows = map.table("box");
  if (rows.size() != 2 || rows[0].size() != 3 || rows[1].size() != 3)
    map.fail("box", "box is of another shape, expected [[x, y, z], [x, y, z]]");
  const Vector3 low = Vector3::Map(rows[0].data()), high = Vector3::Map(rows[1].data());
  if (!(low.array() <= high.array()).all())
    map.fail("box", fmt::format("box is from {} to {}, expected the lowest corner first",
                                fmt::format("({}, {}, {})", low[0], low[1], low[2]),
                                fmt::format("({}, {}, {})", high[0], high[1], high[2])));
  const Vector3 margin = Vector3::Constant(kSame * geometry_io::extents_of(geometry.patches, nullptr).norm());
  return {low - margin, high + margin};
}

void expect_faces(const YamlMap& map, const std::string& key, const std::vector<nurbs::Face>& faces,
                  std::size_t count) {
  if (faces.size() != count)
    map.fail(key, fmt::format("{} has {} faces, expected {} that meet there", key, faces.size(), count));
  const auto twice = first_repeated(faces);
  if (twice != faces.end())
    map.fail(key, fmt::format("{} has {} twice, expected {} faces that meet there", key,
                              nurbs::face_name(*twice), count));
}

std::vector<int> read_patches(const YamlMap& map, const GeometryFile& geometry) {
  const int patches = static_cast<int>(geometry.patches.size());
  if (map.has("patch") && map.is_list("patch")) {
    std::vector<int> some = map.integers("patch", 0, patches - 1);
    if (some.empty()) map.fail("patch", fmt::format("patch is empty, expected some of 0 to {}", patches - 1));
    if (const auto twice = first_repeated(some); twice != some.end())
      map.fail("patch", fmt::format("patch has {} twice, expected once", *twice));
    return some;
  }
  if (map.has("patch") || !map.has("box")) return {read_patch(map, geometry)};
  std::vector<int> all(patches);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

std::vector<std::string> with_selection_keys(std::vector<std::string> keys) {
  keys.insert(keys.end(), {"faces", "edge", "corner", "box", "patch"});
  return keys;
}

nurbs::Face read_face(const YamlMap& map, const std::string& key) { return face_of(map, key, map.word(key)); }

int read_patch(const YamlMap& map, const GeometryFile& geometry) {
  const int patches = static_cast<int>(geometry.patches.size());
  if (map.has("patch")) return map.integer("patch", 0, patches - 1);
  if (patches > 1)
    map.fail("", fmt::format("nothing says of which patch, expected 'patch', 0 to {}", patches - 1));
  return 0;
}

Selection read_selection(const YamlMap& map, const GeometryFile& geometry,
                         const structure::NodeNumbering& nodes) {
  Selection selection{read_patches(map, geometry)};
  std::vector<std::string> given;
  for (const char* const key : {"faces", "edge", "corner", "box"})
    if (map.has(key)) given.emplace_back(key);
  if (given.size() > 1 || (given.empty() && !map.has("patch")))
    map.fail(
        given.empty() ? "" : given.back(),
        fmt::format("{} where it acts, expected one of: faces, edge, corner, box (with patch, if wanted), "
                    "or patch alone",
                    given.empty() ? "nothing says" : "more than one key says"));
  const std::string key = given.empty() ? "patch" : given.front();
  if (key == "box") selection.box = read_box(map, geometry);
  if (key == "faces" || key == "edge" || key == "corner") selection.faces = read_faces(map, key);
  if (key == "faces")
    if (const auto twice = first_repeated(selection.faces); twice != selection.faces.end())
      map.fail(key, fmt::format("faces has {} twice, expected once", nurbs::face_name(*twice)));
  if (key == "edge") expect_faces(map, key, selection.faces, 2);
  if (key == "corner") expect_faces(map, key, selection.faces, 3);
  selection.on_all_of_them = key == "edge" || key == "corner" || key == "patch";
  if (key != "faces" && nodes_of(selection, geometry, nodes).empty())
    map.fail(key, fmt::format("{} has no control points, expected some", key));
  return selection;
}

std::vector<structure::Id> node_ids(const structure::NodeNumbering& nodes, int patch) {
  std::vector<structure::Id> ids;
  for (int point = 0; point < nodes.control_point_count(patch); ++point)
    ids.push_back(nodes.node(patch, point));
  return ids;
}

structure::SkinSurface skin_of(const GeometryFile& geometry, const structure::NodeNumbering& nodes,
                               const structure::SkinPiece& piece) {
  return structure::skin_surface(std::get<nurbs::Volume>(geometry.patches[piece.patch]), piece, nodes);
}

NodeSet nodes_of(const Selection& selection, const GeometryFile& geometry,
                 const structure::NodeNumbering& nodes) {
  NodeSet all;
  for (const int patch : selection.patches)
    for (const int point : points_of_patch(selection, std::get<nurbs::Volume>(geometry.patches[patch])))
      all.push_back(static_cast<int>(nodes.node(patch, point)));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace io
