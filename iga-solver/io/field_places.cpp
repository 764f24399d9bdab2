// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/field_places.h"

#include "structure/weld.h"

namespace io {

std::vector<std::string> field_places(const geometry_io::GeometryFile& geometry) {
  std::vector<std::string> places{kVolumePlace, kSkinPlace};
  for (const auto& [name, pieces] : geometry.surfaces)
    if (name != kVolumePlace && name != kSkinPlace && name.find('/') == std::string::npos)
      places.push_back(name);
  return places;
}

std::vector<structure::SkinPiece> faces_of(const std::string& place,
                                           const geometry_io::GeometryFile& geometry,
                                           const structure::NodeNumbering& nodes) {
  if (place == kSkinPlace) {
    std::vector<nurbs::Space<3>> spaces;
    for (const geometry_io::Shape& patch : geometry.patches)
      spaces.push_back(std::get<nurbs::Volume>(patch).space);
    return structure::free_faces(spaces, nodes);
  }
  std::vector<structure::SkinPiece> faces;
  for (const geometry_io::SurfacePiece& piece : geometry.surfaces.at(place))
    faces.push_back({piece.patch, *piece.face});
  return faces;
}

}  // namespace io
