// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces that a body falls into, and patches that almost touch.
#pragma once

#include <string>
#include <vector>

#include "io/model_file.h"

namespace io {

/// Of each patch, which piece it is of: patches that are welded, directly or through others, are one.
struct Pieces {
  int count;
  std::vector<int> of_patch;
};
Pieces pieces_of(const structure::NodeNumbering& nodes);

/// What is joined less than it looks, a sentence each, if any is.  Before a solver takes the control points.
/// That faces which are not welded are nearer to each other than anybody means, the nearest ones by name: of
/// different pieces, or, where outward sides look at each other, of one; not if welds are not wanted.  That
/// patches share nodes around which no chain of welded faces leads from one to the other.
std::vector<std::string> loose_patches(const ModelFile& model);

}  // namespace io
