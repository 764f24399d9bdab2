// SPDX-License-Identifier: GPL-2.0-or-later
// Which NURBS patches are exact rectangles of planes, cylinders, cones, spheres and tori, and the wall that
// is made of these.
#pragma once

#include <optional>
#include <vector>

#include "brep/chart.h"
#include "brep/surface.h"
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

/// Faces with the patches' numbers, and their charts.
struct ClosedForms {
  Surface surface;
  std::vector<Chart> charts;
};
/// Nothing unless all patches have a closed form.
std::optional<ClosedForms> closed_forms(const std::vector<nurbs::Surface>& patches, double edge_angle);

}  // namespace brep
