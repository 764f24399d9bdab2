// SPDX-License-Identifier: GPL-2.0-or-later
// Geometry files in YAML.  What is read is written and read again: the same.
#include "fuzz_target.h"
#include "geometry_io/geometry_io.h"

namespace {

geometry_io::GeometryFile read(const std::string& text) {
  return geometry_io::read_geometry("wall.yaml", [&](const std::string& path) {
    if (path != "wall.yaml") throw geometry_io::InputError(path + ": there is one file only");
    return text;
  });
}

}  // namespace

void fuzz_one(const std::string& input) {
  const geometry_io::GeometryFile geometry = read(input);
  for (const auto& surface : geometry.surfaces)
    geometry_io::named_surface(geometry, surface.first, "wall.yaml");
  const std::string text = geometry_io::write_geometry(geometry, geometry_io::format::yaml);
  check_that(geometry_io::write_geometry(read(text), geometry_io::format::yaml) == text);
}
