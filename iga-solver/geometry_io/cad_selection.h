// SPDX-License-Identifier: GPL-2.0-or-later
// Words of a deck that name faces of a CAD model.
#pragma once

#include <string>
#include <vector>

#include "brep/cad_model.h"

namespace geometry_io {

/// `all`; `face:12`, its number in the file; `colour:FF8800`, of the face or, if it has none, of its solid;
/// or a name: of faces, of solids, or of assemblies and components that they are in (alone or with those
/// around them, as in `machine/hopper`).  Faces of any of the words, rising, each once.  Throws
/// std::invalid_argument that lists what there is.
std::vector<int> cad_faces(const brep::CadModel& model, const std::vector<std::string>& words);

}  // namespace geometry_io
