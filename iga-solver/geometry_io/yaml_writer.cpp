// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>

#include "geometry_io/formats.h"
#include "geometry_io/input_error.h"

namespace geometry_io {
namespace {

// fmt's "{}" writes the shortest text that reads back as the same number.
template <class Numbers>
std::string list(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

// The emitter puts a placeholder where bytes are not UTF-8, and two names could become one.
std::string quoted_name(const std::string& name) {
  YAML::Emitter out;
  out << YAML::DoubleQuoted << name;
  const std::string text = out.c_str();
  if (YAML::Load(text).Scalar() != name)
    throw std::invalid_argument(
        fmt::format("surface name {} is not UTF-8, expected a name that YAML can hold", shown(name)));
  return text;
}

template <int Dim>
std::string patch_yaml(const nurbs::Patch<Dim>& patch) {
  std::vector<int> degrees;
  std::vector<std::string> knots;
  for (const nurbs::KnotVector& direction : patch.space.knots()) {
    degrees.push_back(direction.degree());
    knots.push_back(list(direction.knots()));
  }
  std::string text = fmt::format("    - degrees: {}\n      knots: {}\n      control_points:\n", list(degrees),
                                 fmt::format("[{}]", fmt::join(knots, ", ")));
  for (const auto& point : patch.control_points.colwise())
    text += fmt::format("        - [{}, {}, {}]\n", point[0], point[1], point[2]);
  if (patch.space.rational()) text += fmt::format("      weights: {}\n", list(patch.space.weights()));
  return text;
}

}  // namespace

std::string write_yaml(const GeometryFile& geometry) {
  std::string text = fmt::format("units: {}\ngeometry:\n  patches:\n", units_name(geometry.units));
  for (const Shape& shape : geometry.patches)
    visit_nurbs(shape, [&](const auto& patch) { text += patch_yaml(patch); });
  if (!geometry.surfaces.empty()) text += "surfaces:\n";
  for (const auto& [name, pieces] : geometry.surfaces)
    text += fmt::format("  {}: {}\n", quoted_name(name), list(surface_words(pieces, geometry.patches)));
  return text;
}

}  // namespace geometry_io
