// SPDX-License-Identifier: GPL-2.0-or-later
// The surfaces that a geometry names: patches that are surfaces, and faces of volumes.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "nurbs/boundary.h"
#include "nurbs/patch.h"

namespace geometry_io {

using Shape = std::variant<nurbs::Surface, nurbs::Volume>;

/// A patch that is a surface, or a face of a patch that is a volume.
struct SurfacePiece {
  int patch;                        ///< from 0
  std::optional<nurbs::Face> face;  ///< nothing for a surface
  bool operator==(const SurfacePiece& other) const { return patch == other.patch && face == other.face; }
};

/// What the words of a file say: `all` (every patch; all must be surfaces), FACE (of the one patch),
/// PATCH (a surface, counted from 0) or "PATCH FACE" (of a volume).  Throws std::invalid_argument, saying
/// what was given and what was expected; also if a piece is named twice or none is.
std::vector<SurfacePiece> parse_surface(const std::vector<std::string>& words,
                                        const std::vector<Shape>& patches);
/// The shortest words that say the same.
std::vector<std::string> surface_words(const std::vector<SurfacePiece>& pieces,
                                       const std::vector<Shape>& patches);

/// One patch of a surface; `outward_sign` as in BoundarySurface, 0 for a surface patch (two-sided).
struct OrientedSurface {
  nurbs::Surface surface;
  int outward_sign;
};
OrientedSurface extract(const SurfacePiece& piece, const std::vector<Shape>& patches);

}  // namespace geometry_io
