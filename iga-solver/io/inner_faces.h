// SPDX-License-Identifier: GPL-2.0-or-later
// Faces of a solid's patches that are no part of its skin, as they are welded to another one.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry_io/geometry_file.h"
#include "structure/body.h"
#include "structure/node_numbering.h"

namespace io {

class InnerFaces {
 public:
  InnerFaces(const geometry_io::GeometryFile& geometry, const structure::NodeNumbering& nodes);

  /// "patch 0 xi+, which is inside the body: welded to patch 1 xi-"; empty if the face is of the skin.
  std::string told(const structure::SkinPiece& face) const;

 private:
  std::vector<std::pair<structure::SkinPiece, structure::SkinPiece>> welded_;
};

}  // namespace io
