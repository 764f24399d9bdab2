// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/damping_keys.h"

#include <fmt/format.h>

namespace io {

DampingKeys read_damping(const geometry_io::YamlMap& map) {
  map.allow_only({"mass", "stiffness", "modal"});
  DampingKeys damping;
  if (map.has("mass")) damping.mass = map.number("mass", geometry_io::non_negative());
  if (map.has("stiffness")) damping.stiffness = map.number("stiffness", geometry_io::positive());
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
