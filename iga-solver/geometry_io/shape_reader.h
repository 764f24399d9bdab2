// SPDX-License-Identifier: GPL-2.0-or-later
// The value of a model file's key `geometry`.  Its keys are listed in geometry_file.h.
#pragma once

#include <string>
#include <vector>

#include "geometry_io/named_surface.h"
#include "geometry_io/yaml_map.h"

namespace geometry_io {

/// The words of shapes and the keys of each.
struct ShapeWords {
  std::string word;
  std::vector<std::string> keys;
};
std::vector<ShapeWords> shape_words();

/// Throws InputError unless there is one shape, `patches`, `shapes` or `file`, beside what changes it
/// (shape_changes.h).
void expect_one_shape(const YamlMap& geometry);

/// Patches of one shape, or those listed under `patches`; one at least.  Throws InputError, with file and
/// line, what was given and what was expected.
std::vector<Shape> read_shapes(const YamlMap& geometry);

}  // namespace geometry_io
