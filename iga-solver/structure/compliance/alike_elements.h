// SPDX-License-Identifier: GPL-2.0-or-later
// Elements of a patch that see the same around them, so that one table serves them all.
#pragma once

#include <vector>

#include "nurbs/patch.h"
#include "structure/compliance/local_patch.h"

namespace structure {

/// Per element of a direction the first one, itself perhaps, that has the same knots around it as far as
/// `extent` may take, and as control values there may depend on; elements that see an end of the patch are
/// like no other, and so are all unless the patch is affine.  By the patch alone, whoever asks first: the
/// same on any number of ranks.
std::vector<int> alike_elements(const nurbs::Volume& patch, int direction, const LocalExtent& extent);

}  // namespace structure
