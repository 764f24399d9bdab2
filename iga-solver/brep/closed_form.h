// SPDX-License-Identifier: GPL-2.0-or-later
// Which NURBS patches are exact rectangles of planes, cylinders, cones, spheres and tori.
#pragma once

#include <optional>

#include "brep/chart.h"
#include "brep/face.h"
#include "nurbs/patch.h"

namespace brep {

/// A patch as a face.
struct ClosedForm {
  Face face;
  Chart chart;
};

/// Of a patch as nurbs/primitives.h makes them, refined, turned, moved and scaled as it may be: the first
/// direction turns about an axis, the second is straight or an arc.  Nothing for others: skew planes, rings,
/// ellipses, or if one of some 1,000 points compared is off by more than 1e-13 of the size.
std::optional<ClosedForm> closed_form(const nurbs::Surface& patch);

}  // namespace brep
