// SPDX-License-Identifier: GPL-2.0-or-later
// The `units`, `geometry` and `surfaces` part of a model file; a rigid wall's file has nothing else.
//
//   units: si                                   # si | cgs | mm-g-ms
//   geometry:                                   # one of:
//     box: {origin: [x,y,z], size: [x,y,z], elements: [31,31,8], degree: 2}
//     plane: {origin: [x,y,z], edges: [[x,y,z],[x,y,z]], elements: [10,10], degree: 2}
//     patches: [{degrees: [2,2], knots: [[..],[..]], control_points: [[x,y,z],..], weights: [..]}]
//   surfaces: {top: zeta+}                      # a volume's face; `all` for a surface patch
//
// `degree` is one number or one per direction; `breaks: [[0, .5, 1], ..]` (relative, from 0 to 1) may stand
// in place of `elements` for graded meshes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>

#include "nurbs/boundary.h"
#include "nurbs/patch.h"
#include "nurbs/yaml_map.h"

namespace nurbs {

enum class Units { si, cgs, mm_g_ms };
const char* units_name(Units units);

/// What the three keys say.  `surfaces` maps a name to a face, or to nothing where the geometry is a surface
/// itself.
struct GeometryFile {
  Units units;
  std::variant<Surface, Volume> patch;
  std::map<std::string, std::optional<Face>> surfaces;
};

/// Reads the three keys from a document that may have others (a model file).  Throws InputError.
GeometryFile read_geometry(const YamlMap& document);
/// A rigid wall's file: any other top-level key is an error.
GeometryFile parse_geometry_file(const std::string& text, const std::string& file);

/// One named surface as a patch of its own; `outward_sign` as in BoundarySurface, 0 for a surface patch
/// (two-sided).
struct NamedSurface {
  Surface surface;
  int outward_sign;
};
/// Throws InputError that lists the names there are.
NamedSurface named_surface(const GeometryFile& geometry, const std::string& name, const std::string& file);

}  // namespace nurbs
