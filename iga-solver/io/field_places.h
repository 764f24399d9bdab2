// SPDX-License-Identifier: GPL-2.0-or-later
// Where fields of a solid are written: on the whole `volume`, on its `skin` (all faces that are not welded to
// others), and on the surfaces that the model names.
#pragma once

#include <string>
#include <vector>

#include "geometry_io/geometry_file.h"
#include "structure/body.h"
#include "structure/node_numbering.h"

namespace io {

constexpr const char* kVolumePlace = "volume";
constexpr const char* kSkinPlace = "skin";

/// The words, those of surfaces last.  A surface called as one of the others, or by a name that no file can
/// have, has none.
std::vector<std::string> field_places(const geometry_io::GeometryFile& geometry);

/// The faces of a place that is not the volume.
std::vector<structure::SkinPiece> faces_of(const std::string& place,
                                           const geometry_io::GeometryFile& geometry,
                                           const structure::NodeNumbering& nodes);

}  // namespace io
