// SPDX-License-Identifier: GPL-2.0-or-later
// Guards against a slip of the finger in what a file asks for, and who is to blame for it.
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry_io/yaml_map.h"

namespace geometry_io {

struct ShapeLimits {
  int elements = 1000000;                                   ///< of one direction
  double control_points = std::numeric_limits<int>::max();  ///< of a patch
};
/// Those that readers hold files to.  A fuzzer asks for every size and sets smaller ones: the same checks,
/// sooner.
ShapeLimits& shape_limits();

/// Runs `build`; what it finds wrong with its arguments is an error of the file at `key`.
template <class Build>
auto blame(const YamlMap& map, const std::string& key, const std::string& prefix, Build build) {
  try {
    return build();
  } catch (const std::invalid_argument& error) {
    map.fail(key, prefix + error.what());
  }
}

/// Asked before anything is allocated for the elements of all directions that `key` gives.
void expect_size(const YamlMap& map, const std::string& key, const std::vector<int>& elements,
                 const std::vector<int>& degrees);
/// InputError unless a list has the length that is expected.
void expect_count(const YamlMap& map, const std::string& key, size_t given, size_t expected);

}  // namespace geometry_io
