// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/integration_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/inner_faces.h"
#include "structure/material/plate_material.h"
#include "structure/solid/plate_patch.h"

namespace io {

using geometry_io::YamlMap;

namespace {

/// A word, by the reader that knows all of them.
template <class Value>
Value read_word(const YamlMap& map, const std::string& key, Value (*from_name)(const std::string&)) {
  try {
    return from_name(map.word(key));
  } catch (const std::invalid_argument& error) {
    map.fail(key, error.what());
  }
}

/// Nodes that are held or moved in some direction, rising; springs leave them free.
structure::NodeSet held_nodes(const std::vector<BoundaryEntry>& boundary) {
  structure::NodeSet held;
  for (const BoundaryEntry& entry : boundary)
    if (!entry.spring) held.insert(held.end(), entry.nodes.begin(), entry.nodes.end());
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace

structure::Integration read_integration(const YamlMap& map) {
  map.allow_only({"quadrature", "method", "mass", "shear"});
  structure::Integration integration;
  if (map.has("quadrature"))
    integration.quadrature = read_word(map, "quadrature", structure::quadrature_from_name);
  if (map.has("method"))
    integration.method = read_word(map, "method", structure::integration_method_from_name);
  if (map.has("mass")) integration.mass = read_word(map, "mass", structure::time_mass_from_name);
  return integration;
}

void correct_shear(const YamlMap& map, const geometry_io::GeometryFile& geometry,
                   const structure::NodeNumbering& nodes, const std::vector<BoundaryEntry>& boundary,
                   std::vector<std::shared_ptr<const structure::Material>>& materials) {
  if (!map.has("shear") || map.word_of("shear", {"plain", "corrected"}) == "plain") return;
  using Key = std::pair<const structure::Material*, std::array<double, 3>>;
  std::map<Key, std::shared_ptr<const structure::Material>> made;  // those that were one stay one
  const std::vector<std::shared_ptr<const structure::Material>> given = materials;
  const InnerFaces inner(geometry, nodes);
  const structure::NodeSet held = held_nodes(boundary);
  const auto is_free = [&](int patch, nurbs::Face side) {
    structure::NodeSet on_side = nodes_of({{patch}, {side}}, geometry, nodes);
    return inner.told({patch, side}).empty() &&
           !std::includes(held.begin(), held.end(), on_side.begin(), on_side.end());
  };
  for (int p = 0; p < static_cast<int>(materials.size()); ++p) {
    const auto& volume = std::get<nurbs::Volume>(geometry.patches[p]);
    const int direction = structure::thickness_direction(volume.space);
    if (direction < 0 || !is_free(p, static_cast<nurbs::Face>(2 * direction)) ||
        !is_free(p, static_cast<nurbs::Face>(2 * direction + 1)))
      continue;
    try {
      const nurbs::Vector3 n = structure::plate_normal(volume, direction);
      auto& material = made[{given[p].get(), {n[0], n[1], n[2]}}];
      if (!material) material = structure::with_plate_shear(*given[p], n);
      materials[p] = material;
    } catch (const std::invalid_argument& problem) {
      map.fail("shear", fmt::format("shear is 'corrected', but patch {} {}", p, problem.what()));
    }
  }
  if (made.empty())
    map.fail("shear",
             "shear is 'corrected', but no patch is a single quadratic element thick in just one direction, "
             "with neither side welded or held: two layers, or degree 3, need no correction");
}

}  // namespace io
