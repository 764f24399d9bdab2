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

/// In how many rigid motions supports and springs leave a piece of the body free: the first such piece, by
/// its first patch, or "it" where there is one.
struct FreeMotions {
  std::size_t count = 0;
  std::string whose = {};
};
/// Before a solver takes the control points, as what follows.
FreeMotions free_motions(const io::ModelFile& model);

/// Of a model with an analysis.  Throws std::runtime_error if one of several pieces has no equilibrium, as
/// nothing holds it; a body in one piece is the analysis' own matter.
void expect_held_pieces(const io::ModelFile& model);

/// That faces which are not welded are nearer to each other than anybody means, the nearest ones by name: of
/// different pieces, or, where outward sides look at each other, of one.  Empty if none are, or welds are not
/// wanted.
std::string almost_welded(const io::ModelFile& model);

/// That patches share nodes around which no chain of welded faces leads from one to the other; empty if none
/// do.
std::string hinges(const io::ModelFile& model);

}  // namespace app
