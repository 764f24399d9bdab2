// SPDX-License-Identifier: GPL-2.0-or-later
// Elements of the skin so flat, or so slender, that too many take part in their local problem.
#pragma once

#include <vector>

#include "structure/compliance/local_patch.h"

namespace structure {

/// How many unknowns the local problem of an element has, about: where the patch goes on beyond a weld, that
/// is not looked at.
double unknowns_about(const nurbs::Volume& patch, int element, const LocalExtent& extent);

/// Throws std::invalid_argument, which names the worst of them, if there are such, as LocalProblem would when
/// one of them is hit.  About so (unknowns_about).
void expect_no_flat_elements(const ReferenceBody& body, const std::vector<SkinPiece>& skin);

}  // namespace structure
