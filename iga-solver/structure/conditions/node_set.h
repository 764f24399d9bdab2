// SPDX-License-Identifier: GPL-2.0-or-later
// Sets of nodes that conditions act on: given by faces, edges, corners, or boxes.
#pragma once

#include <vector>

#include "nurbs/boundary.h"

namespace structure {

/// Nodes, rising, each once.
using NodeSet = std::vector<int>;

/// Control points of a volume that lie on all of these faces: of one a face, of two an edge, of three a
/// corner; opposite faces have none in common.
NodeSet nodes_on(const nurbs::Space<3>& volume, const std::vector<nurbs::Face>& faces);

/// Those of `positions` (3 x n) [length] in the axis-parallel box from `low` to `high`, borders included.
NodeSet nodes_within(const nurbs::NodalVectors& positions, const nurbs::Vector3& low,
                     const nurbs::Vector3& high);

}  // namespace structure
