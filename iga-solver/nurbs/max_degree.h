// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace nurbs {

/// Highest polynomial degree; fixes the size of every evaluation's stack buffers.
constexpr int kMaxDegree = 6;

}  // namespace nurbs
