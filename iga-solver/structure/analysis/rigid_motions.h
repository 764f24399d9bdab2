// SPDX-License-Identifier: GPL-2.0-or-later
// The six motions of a rigid body.
#pragma once

#include <array>
#include <vector>

#include "structure/body.h"
#include "structure/conditions/springs.h"
#include "structure/conditions/supports.h"

namespace structure {

/// Three translations, and three rotations about the middle of the nodes over the body's size: 3 x
/// node_count.
std::array<NodalVectors, 6> rigid_motions(const NodalVectors& reference);

/// Independent ones that the supports leave to a body whose nodes are at `positions`, and that strain no
/// spring; none if they hold it.
std::vector<NodalVectors> free_rigid_motions(const NodalVectors& positions, const Supports& supports,
                                             const Springs& springs = {});

}  // namespace structure
