// SPDX-License-Identifier: GPL-2.0-or-later
// The value of a model file's key `geometry`: one shape.  Its keys are listed in geometry_file.h.
#pragma once

#include <variant>

#include "nurbs/patch.h"
#include "nurbs/yaml_map.h"

namespace nurbs {

using Shape = std::variant<Surface, Volume>;

/// Throws InputError, with file and line, what was given and what was expected.
Shape read_shape(const YamlMap& geometry);

}  // namespace nurbs
