// SPDX-License-Identifier: GPL-2.0-or-later
// What a model file says of its solid beside the mesh, as texts: a saved state keeps them, so that a run
// which goes on from it can tell what has changed since.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geometry_io/yaml_map.h"
#include "structure/material/material.h"

namespace io {

/// "loads.gravity", "[0, 0, -9.81]".
struct Setting {
  std::string name, text;
};
using Settings = std::vector<Setting>;

/// Densities and materials of each patch, integration, damping, boundary and each kind of loads.
Settings settings_of(const geometry_io::YamlMap& document,
                     const std::vector<std::shared_ptr<const structure::Material>>& materials);

/// As a list of texts, for files, and back.
std::vector<std::string> to_texts(const Settings& settings);
Settings settings_from(const std::vector<std::string>& texts);

/// "loads.gravity: [0, 0, -9.81] then, none now; ...": what differs, of settings whose names begin with
/// `kind`; empty if nothing does.
std::string difference(const Settings& then, const Settings& now, const std::string& kind = "");

}  // namespace io
