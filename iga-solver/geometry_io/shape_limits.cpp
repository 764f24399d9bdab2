// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/shape_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "nurbs/memory.h"

namespace geometry_io {

ShapeLimits& shape_limits() {
  static ShapeLimits limits;
  return limits;
}

void expect_size(const YamlMap& map, const std::string& key, const std::vector<int>& elements,
                 const std::vector<int>& degrees) {
  const std::string prefix = key == "elements" ? "" : key + ": ";
  double count = 1.0;
  for (size_t d = 0; d < elements.size(); ++d) count *= static_cast<double>(elements[d]) + degrees[d];
  blame(map, key, prefix, [&] {
    nurbs::expect_memory(sizeof(nurbs::Vector3) * count, fmt::format("elements [{}]: {:.3g} control points",
                                                                     fmt::join(elements, ", "), count));
  });
  if (count > shape_limits().control_points)
    map.fail(key,
             prefix + fmt::format("elements are {}, about {:.3g} control points, expected at most {:.0f}",
                                  fmt::join(elements, " x "), count, shape_limits().control_points));
}

void expect_count(const YamlMap& map, const std::string& key, size_t given, size_t expected) {
  if (given != expected) map.fail(key, fmt::format("{} is a list of {}, expected {}", key, given, expected));
}

}  // namespace geometry_io
