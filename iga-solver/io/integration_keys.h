// SPDX-License-Identifier: GPL-2.0-or-later
// The key `integration` of a model file: how integrals are worked out, and what is corrected in them.
#pragma once

#include <memory>
#include <vector>

#include "geometry_io/geometry_file.h"
#include "geometry_io/yaml_map.h"
#include "io/boundary_keys.h"
#include "structure/material/material.h"
#include "structure/node_numbering.h"
#include "structure/solid/solid_patch.h"

namespace io {

/// Throws geometry_io::InputError.
structure::Integration read_integration(const geometry_io::YamlMap& map);

/// `shear: corrected`: gives patches that are flat plates of a single quadratic element, with neither side
/// welded or held, the material that they need (structure/material/plate_shear.h).  Throws
/// geometry_io::InputError if there is none, or one that is not flat or of another law.
void correct_shear(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry,
                   const structure::NodeNumbering& nodes, const std::vector<BoundaryEntry>& boundary,
                   std::vector<std::shared_ptr<const structure::Material>>& materials);

}  // namespace io
