// SPDX-License-Identifier: GPL-2.0-or-later
// The surfaces that a geometry names: patches that are surfaces, and faces of volumes.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "geometry_io/triangle_mesh.h"
#include "nurbs/boundary.h"
#include "nurbs/patch.h"

namespace geometry_io {

/// A patch: NURBS, or triangles, which are a surface too.
using Shape = std::variant<nurbs::Surface, nurbs::Volume, TriangleMesh>;

inline bool is_volume(const Shape& shape) { return std::holds_alternative<nurbs::Volume>(shape); }
inline bool is_triangles(const Shape& shape) { return std::holds_alternative<TriangleMesh>(shape); }

/// Calls `visit` with the Surface or Volume.  Throws std::invalid_argument if it is triangles.
template <class SomeShape, class Visit>
void visit_nurbs(SomeShape& shape, Visit visit) {
  if (auto* surface = std::get_if<nurbs::Surface>(&shape))
    visit(*surface);
  else if (auto* volume = std::get_if<nurbs::Volume>(&shape))
    visit(*volume);
  else
    throw std::invalid_argument("a patch is triangles (STL), expected NURBS");
}

/// The surface of all patches.
constexpr const char* kAllPatches = "all";

/// A patch that is a surface, or a face of a patch that is a volume.
struct SurfacePiece {
  int patch;                        ///< from 0
  std::optional<nurbs::Face> face;  ///< nothing for a surface
  bool operator==(const SurfacePiece& other) const { return patch == other.patch && face == other.face; }
};

/// What the words of a file say: `all` (every patch; all must be surfaces), FACE (of the one patch),
/// PATCH (a surface, counted from 0), "PATCH FACE" (of a volume), or the name of patches of triangles. Throws
/// std::invalid_argument, saying what was given and what was expected; also if a piece is named twice or none
/// is.
std::vector<SurfacePiece> parse_surface(const std::vector<std::string>& words,
                                        const std::vector<Shape>& patches);
/// The shortest words that say the same.
std::vector<std::string> surface_words(const std::vector<SurfacePiece>& pieces,
                                       const std::vector<Shape>& patches);

/// One patch of a surface; `outward_sign` as in BoundarySurface, 0 for a surface patch (two-sided).
struct OrientedSurface {
  nurbs::Surface surface;
  int outward_sign;
  bool from_words = false;  ///< as in GeometryFile
};
/// Of NURBS; throws std::bad_variant_access of triangles.
OrientedSurface extract(const SurfacePiece& piece, const std::vector<Shape>& patches);

}  // namespace geometry_io
