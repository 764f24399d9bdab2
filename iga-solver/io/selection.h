// SPDX-License-Identifier: GPL-2.0-or-later
// Where a condition of a model file acts: `faces: [xi-, xi+]` (on any of them), `edge: [xi+, zeta-]` and
// `corner: [xi-, eta-, zeta+]` (on all of them), `box: [[x, y, z], [x, y, z]]` (control points between two
// corners), each of the patch `patch: N` or the patches `patch: [N, M]`, or with it alone all of them.  A box
// is of all patches where none is named, and where there is one patch it need not be.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry_io/geometry_file.h"
#include "structure/conditions/node_set.h"
#include "structure/conditions/skin_surface.h"
#include "structure/node_numbering.h"

namespace io {

using nurbs::Vector3;

struct Selection {
  std::vector<int> patches = {0};
  std::vector<nurbs::Face> faces = {};
  bool on_all_of_them = false;  ///< an edge, a corner, or, without faces, all of the patch
  /// Lowest and highest corner [length], with room for round-off.
  std::optional<std::array<Vector3, 2>> box = {};
};

/// Keys of a selection, to be allowed beside those of the condition.
std::vector<std::string> with_selection_keys(std::vector<std::string> keys);
/// Throws geometry_io::InputError unless there is one, and it has nodes.
Selection read_selection(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry,
                         const structure::NodeNumbering& nodes);
/// The value of `key`, a face.
nurbs::Face read_face(const geometry_io::YamlMap& map, const std::string& key);
/// `patch`, which may be left out where there is one.
int read_patch(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry);

/// Nodes of the whole body, per control point of a patch.
std::vector<structure::Id> node_ids(const structure::NodeNumbering& nodes, int patch);
/// A piece of the undeformed skin.
structure::SkinSurface skin_of(const geometry_io::GeometryFile& geometry,
                               const structure::NodeNumbering& nodes, const structure::SkinPiece& piece);
/// Nodes of the whole body, rising.
structure::NodeSet nodes_of(const Selection& selection, const geometry_io::GeometryFile& geometry,
                            const structure::NodeNumbering& nodes);

}  // namespace io
