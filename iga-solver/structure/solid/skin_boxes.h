// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "structure/body.h"
#include "structure/solid/box_grid.h"

namespace structure {

/// The elements of a face of a patch, of those boxes that have some, in the order of the boxes.
std::vector<SkinBox> skin_boxes(const nurbs::Space<3>& space, nurbs::Face face,
                                const std::vector<PlacedBox>& boxes);

}  // namespace structure
