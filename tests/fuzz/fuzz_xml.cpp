// SPDX-License-Identifier: GPL-2.0-or-later
// Geometry files in G+Smo's XML.  What is read is written as YAML and read again: the same.
#include "fuzz_target.h"
#include "geometry_io/geometry_io.h"

namespace {

geometry_io::GeometryFile read(const std::string& path, const std::string& text) {
  return geometry_io::read_geometry(path, [&](const std::string&) { return text; });
}

}  // namespace

void fuzz_one(const std::string& input) {
  const geometry_io::GeometryFile geometry = read("wall.xml", input);
  for (const auto& surface : geometry.surfaces)
    geometry_io::named_surface(geometry, surface.first, "wall.xml");
  const std::string text = geometry_io::write_geometry(geometry, geometry_io::format::yaml);
  check_that(geometry_io::write_geometry(read("wall.yaml", text), geometry_io::format::yaml) == text);
}
