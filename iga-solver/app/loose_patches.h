// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces that a body falls into, and patches that almost touch.
#pragma once

#include <string>
#include <vector>

#include "io/model_file.h"

namespace app {

/// Of each patch, which piece it is of: patches that are welded, directly or through others, are one.
struct Pieces {
  int count;
  std::vector<int> of_patch;
};
Pieces pieces_of(const structure::NodeNumbering& nodes);

/// That faces of different pieces are nearer to each other than anybody means, the nearest ones by name;
/// empty if none are, or welds are not wanted.  Before a solver takes the control points.
std::string almost_welded(const io::ModelFile& model);

}  // namespace app
