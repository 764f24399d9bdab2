// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/inner_faces.h"

#include <fmt/format.h>

#include <variant>

#include "structure/weld.h"

namespace io {

InnerFaces::InnerFaces(const geometry_io::GeometryFile& geometry, const structure::NodeNumbering& nodes) {
  if (nodes.welded().empty()) return;
  std::vector<nurbs::Space<3>> spaces;
  for (const geometry_io::Shape& patch : geometry.patches)
    spaces.push_back(std::get<nurbs::Volume>(patch).space);
  welded_ = structure::welded_faces(spaces, nodes);
}

std::string InnerFaces::told(const structure::SkinPiece& face) const {
  for (const auto& [one, other] : welded_)
    if (one.patch == face.patch && one.face == face.face)
      return fmt::format("patch {} {}, which is inside the body: welded to patch {} {}", one.patch,
                         nurbs::face_name(one.face), other.patch, nurbs::face_name(other.face));
  return "";
}

}  // namespace io
