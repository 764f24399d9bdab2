// SPDX-License-Identifier: GPL-2.0-or-later
// Which rigid motions of a body nothing holds.
#pragma once

#include <cstddef>
#include <string>

#include "io/model_file.h"

namespace app {

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

}  // namespace app
