// SPDX-License-Identifier: GPL-2.0-or-later
// Which boxes overlap: a tree of boxes beside itself.
#pragma once

#include <functional>
#include <vector>

#include "search/box.h"

namespace geometry_io {

/// Calls visit(i, j) once for each two boxes that overlap or touch, in no order, i and j neither.  Takes a
/// time that grows as n log n, and with the number of these pairs.
void for_box_pairs(const std::vector<search::Box>& boxes, const std::function<void(int, int)>& visit);

}  // namespace geometry_io
