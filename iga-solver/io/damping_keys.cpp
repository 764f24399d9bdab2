// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/damping_keys.h"

#include <fmt/format.h>

#include <array>

namespace io {

namespace {

/// A viscous law remembers the strain of each point of an element.
void expect_one_degree(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry) {
  const auto degrees = [&](std::size_t patch) {
    const nurbs::Space<3>& space = std::get<nurbs::Volume>(geometry.patches[patch]).space;
    return std::array{space.degree(0), space.degree(1), space.degree(2)};
  };
  for (std::size_t patch = 1; patch < geometry.patches.size(); ++patch)
    if (degrees(patch) != degrees(0))
      map.fail(
          "stiffness",
          fmt::format(
              "damping.stiffness is given where patches 0 and {} have degrees {} and {}, expected the same "
              "degrees in all patches: raise the lower by 'refine', or damp by 'mass' alone",
              patch, fmt::join(degrees(0), " "), fmt::join(degrees(patch), " ")));
}

}  // namespace

DampingKeys read_damping(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry) {
  map.allow_only({"mass", "stiffness", "modal"});
  DampingKeys damping;
  if (map.has("mass")) damping.mass = map.number("mass", geometry_io::non_negative());
  if (map.has("stiffness")) {
    damping.stiffness = map.number("stiffness", geometry_io::positive());
    expect_one_degree(map, geometry);
  }
  if (!map.has("modal")) return damping;
  if (map.is_list("modal"))
    damping.modal = map.numbers("modal");
  else
    damping.modal = {map.number("modal")};
  for (const double ratio : damping.modal)
    if (!(ratio >= 0.0))
      map.fail("modal", fmt::format("modal has {}, expected shares of critical damping, 0 or more", ratio));
  return damping;
}

}  // namespace io
