// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/material_keys.h"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <string>

#include "structure/material/laws.h"
#include "structure/material/viscous.h"

namespace io {

using geometry_io::YamlMap;

namespace {

std::shared_ptr<const structure::Material> read_constants(const YamlMap& map,
                                                          const structure::MaterialLaw& law) {
  std::vector<std::string> keys = {"law", "patches"};
  for (const structure::MaterialConstant& constant : law.constants) keys.emplace_back(constant.key);
  for (const structure::MaterialDirection& direction : law.directions) keys.emplace_back(direction.key);
  map.allow_only(keys);
  std::vector<double> values;
  for (const structure::MaterialConstant& constant : law.constants)
    values.push_back(map.number(constant.key, {constant.low, constant.high}));
  for (const structure::MaterialDirection& direction : law.directions) {
    const Eigen::Vector3d v = map.has(direction.key) ? map.vector3(direction.key) : direction.otherwise;
    values.insert(values.end(), v.begin(), v.end());
  }
  try {
    return law.make(values);
  } catch (const std::invalid_argument& error) {
    map.fail("law", error.what());
  }
}

std::shared_ptr<const structure::Material> read_material(const YamlMap& map) {
  std::vector<std::string> known;
  for (const structure::MaterialLaw& law : structure::material_laws()) known.emplace_back(law.word);
  if (!map.has("law"))
    map.fail("", fmt::format("law is missing, expected one of: {}", fmt::join(known, ", ")));
  const std::string name = map.word("law");
  for (const structure::MaterialLaw& law : structure::material_laws())
    if (name == law.word) return read_constants(map, law);
  map.fail("law", fmt::format("law is '{}', {}", name, geometry_io::expected_one_of(name, known)));
}

}  // namespace

std::vector<std::shared_ptr<const structure::Material>> read_materials(const YamlMap& document,
                                                                       int patch_count) {
  if (!document.is_list("material")) {
    const YamlMap map = document.map("material");
    if (map.has("patches"))
      map.fail("patches", "patches is given for the only material, expected it in a list of materials");
    return std::vector(patch_count, read_material(map));
  }
  std::vector<std::shared_ptr<const structure::Material>> materials(patch_count);
  for (const YamlMap& map : document.list_of_maps("material")) {
    const std::shared_ptr<const structure::Material> material = read_material(map);
    for (const int patch : map.integers("patches", 0, patch_count - 1)) {
      if (materials[patch])
        map.fail("patches", fmt::format("patch {} has two materials, expected one", patch));
      materials[patch] = material;
    }
  }
  for (int patch = 0; patch < patch_count; ++patch)
    if (!materials[patch])
      document.fail("material",
                    fmt::format("patch {} has no material, expected one for each of the {} patches", patch,
                                patch_count));
  return materials;
}

void add_viscosity(double time, std::vector<std::shared_ptr<const structure::Material>>& materials) {
  std::map<const structure::Material*, std::shared_ptr<const structure::Material>> viscous;
  for (std::shared_ptr<const structure::Material>& material : materials) {
    std::shared_ptr<const structure::Material>& with = viscous[material.get()];
    if (!with) with = std::make_shared<structure::Viscous>(material, time);
    material = with;
  }
}

}  // namespace io
