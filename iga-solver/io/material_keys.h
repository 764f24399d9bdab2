// SPDX-License-Identifier: GPL-2.0-or-later
// The key `material` of a model file: one for all patches, `material: {law: ..., ...}`, or a list of them,
// each for its patches: `material: [{patches: [0, 1], law: ..., ...}, ...]`.
#pragma once

#include <memory>
#include <vector>

#include "geometry_io/yaml_map.h"
#include "structure/material/material.h"

namespace io {

/// One for each patch.  Throws geometry_io::InputError, also if a patch has none or two.
std::vector<std::shared_ptr<const structure::Material>> read_materials(const geometry_io::YamlMap& document,
                                                                       int patch_count);

/// Makes them viscous in proportion to their stiffness: `time` times it.  Those that were one stay one.
void add_viscosity(double time, std::vector<std::shared_ptr<const structure::Material>>& materials);

}  // namespace io
