// SPDX-License-Identifier: GPL-2.0-or-later
// How the edges of surface patches meet: free, shrunk to a point, or welded to another edge, and how
// smoothly. Kinds of continuity: Piegl & Tiller (1997), section 9.1 and DeRose & Barsky (1985), "An intuitive
// approach to geometric continuity".
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

/// Sides of a surface: 0 xi-, 1 xi+, 2 eta-, 3 eta+.
constexpr int kSideCount = 4;
const char* side_name(int side);
/// The control points of a patch that an edge has, along it.
std::vector<int> side_control_points(const Space<2>& patch, int side);

/// One edge of a patch and what it meets.
struct Border {
  enum Kind { free, pole, welded } kind = free;
  int patch = -1, side = -1;  ///< welded: the edge it meets, maybe of the same patch (a seam); else -1
  bool reversed = false;      ///< welded: the two edges run in opposite directions
  double max_angle = 0.0;  ///< welded: largest angle between the normals, 0 (smooth, G1) to pi (fold) [rad]
  /// Welded: largest difference between the derivatives across the border, relative to the derivative, after
  /// the best constant factor between the two parametrisations; 0 is C1.
  double max_jump = 0.0;
  /// Welded: the neighbour's edge moved by this is the patch's own; not zero across periodic faces [length].
  Vector3 translation = Vector3::Zero();
};

/// Borders [patch][side].  Two edges weld if they are one curve with one parametrisation, up to an affine map
/// and its direction (degrees and knots may differ); an edge that is one point is a pole.  Both within
/// relative_tolerance times the diagonal of the box of all control points.  Where more than two edges share a
/// curve, the smoothest pair welds and the others stay free.  Normals are skipped where they vanish (poles).
/// `periods`: translations that leave the surroundings as they are; edges also weld to edges moved by one.
/// `may_weld`: of two edges that are one curve, whether they stay so; all do unless it is given.
using Borders = std::vector<std::array<Border, kSideCount>>;
using MayWeld = std::function<bool(int patch, int side, int other_patch, int other_side)>;
Borders find_borders(const std::vector<Surface>& patches, double relative_tolerance = 1e-9,
                     const std::vector<Vector3>& periods = {}, const MayWeld& may_weld = {});

/// Of the sides that are one curve, in the sense of find_borders, the first (kSideCount * patch + side).
struct SideCurve {
  int first;
  bool reversed = false;  ///< it runs against the first
};
/// Of all sides [patch][side]; a pole is its own first.
std::vector<std::array<SideCurve, kSideCount>> curves_of_sides(const std::vector<Surface>& patches,
                                                               double relative_tolerance = 1e-9);

/// Largest angle between the normals on both sides of a C0 knot inside a patch, or of all those of one
/// direction; poles do not count [rad].
double kink_at(const Surface& surface, int direction, double knot);
double largest_kink(const Surface& surface, int direction);

/// Whether dS/dxi x dS/deta lies on the same side of both patches beyond the border of `side`.  max_angle
/// counts from the neighbour's normal turned to the same side.
bool same_orientation(int side, const Border& border);

}  // namespace nurbs
