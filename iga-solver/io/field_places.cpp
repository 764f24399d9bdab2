// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/field_places.h"

namespace io {

std::vector<std::string> field_places(const geometry_io::GeometryFile& geometry) {
  std::vector<std::string> places{kVolumePlace, kSkinPlace};
  for (const auto& [name, pieces] : geometry.surfaces)
    if (name != kVolumePlace && name != kSkinPlace && name.find('/') == std::string::npos)
      places.push_back(name);
  return places;
}

std::vector<nurbs::Face> faces_of(const std::string& place, const geometry_io::GeometryFile& geometry) {
  std::vector<nurbs::Face> faces;
  if (place == kSkinPlace) {
    for (int face = 0; face < 6; ++face) faces.push_back(static_cast<nurbs::Face>(face));
    return faces;
  }
  for (const geometry_io::SurfacePiece& piece : geometry.surfaces.at(place)) faces.push_back(*piece.face);
  return faces;
}

}  // namespace io
