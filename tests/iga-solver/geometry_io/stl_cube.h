// SPDX-License-Identifier: GPL-2.0-or-later
// A cube of 12 triangles as STL files of both kinds.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace geometry_io {

using Corner = std::array<float, 3>;
using Facet = std::array<Corner, 3>;

/// The unit cube: two triangles on each of its sides, x-, x+, y-, ..., normals outwards.
inline std::vector<Facet> cube_facets() {
  std::vector<Facet> facets;
  for (int d = 0; d < 3; ++d)
    for (const float side : {0.0F, 1.0F}) {
      const auto corner = [&](float a, float b) {
        Corner point{};
        point[d] = side, point[(d + 1) % 3] = side > 0.0F ? a : b, point[(d + 2) % 3] = side > 0.0F ? b : a;
        return point;
      };
      facets.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
      facets.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
  return facets;
}

inline std::string ascii_facet(const Facet& facet) {
  std::string text = "  facet normal 0 0 0\n    outer loop\n";
  for (const Corner& corner : facet)
    text += "      vertex " + std::to_string(corner[0]) + " " + std::to_string(corner[1]) + " " +
            std::to_string(corner[2]) + "\n";
  return text + "    endloop\n  endfacet\n";
}

inline std::string ascii_stl(const std::vector<Facet>& facets, const std::string& name = "cube") {
  std::string text = "solid " + name + "\n";
  for (const Facet& facet : facets) text += ascii_facet(facet);
  return text + "endsolid " + name + "\n";
}

/// On machines that are little endian.
inline std::string binary_stl(const std::vector<Facet>& facets, std::string header = "") {
  header.resize(80, ' ');
  const auto append = [&header](const auto& value) {
    header.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(facets.size()));
  for (const Facet& facet : facets) {
    append(Corner{});
    append(facet);
    append(std::uint16_t{0xFFFF});  // an attribute
  }
  return header;
}

}  // namespace geometry_io
