// SPDX-License-Identifier: GPL-2.0-or-later
// The names of the geometry kernel that searches use throughout.
#pragma once

#include "nurbs/multi_patch.h"

namespace search {

using nurbs::Indices;
using nurbs::kMaxDegree;
using nurbs::KnotVector;
using nurbs::MultiPatch;
using nurbs::NodalVectors;
using nurbs::Parameter;
using nurbs::power;
using nurbs::Space;
using nurbs::SurfacePoint;
using nurbs::Vector3;

}  // namespace search
