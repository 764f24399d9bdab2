// SPDX-License-Identifier: GPL-2.0-or-later
// The normal of a surface everywhere, also where its two tangents give none or several: on kinks and poles.
#pragma once

#include "nurbs/multi_patch.h"

namespace nurbs {

/// Unit normal to the side of dS/dxi x dS/deta of the patch `at.patch`, whatever the orientation of its
/// neighbours. Where several normals meet (creases, knots, welded borders, corners) their mean, each weighted
/// by the angle under which its element is seen from the point (Baerentzen & Aanaes 2005, "Signed distance
/// computation using the angle weighted pseudonormal"): it does not depend on how the surface is cut into
/// elements and patches.  At a pole that mean is taken over all ways that lead off it: the axis at the tip of
/// a cone. Where the tangents are parallel (the corners of a disc) the limit from inside; where second
/// derivatives do not tell that either, or the normals cancel (a sheet folded flat), the mean over the
/// elements of at.patch around the point; the z axis if those have no area.  Never not-a-number for finite
/// control points. Parameters within 1e-12 of the patch's range of a knot are on it, within 1e-8 of an
/// element of a pole, on that.
Vector3 normal_at(const MultiPatch& surface, const NodalVectors& control_points, const SurfacePoint& at);

}  // namespace nurbs
