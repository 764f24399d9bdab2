// SPDX-License-Identifier: GPL-2.0-or-later
// Random surfaces and points to try closest-point searches on.
#pragma once

#include "nurbs/shapes.h"

namespace nurbs::trials {

enum class Family {
  hills,    ///< a graph, smooth, gentle
  rough,    ///< radii of curvature of a fraction of an element
  folded,   ///< free form, cutting through itself
  creased,  ///< graded knots of any multiplicity, C0 lines among them
  pole,     ///< an edge drawn together in one point: tents and sphere octants
  exact,    ///< tubes, spheres and tori of rational arcs that meet in C0 lines
  ball,     ///< spheres, whole or cut by meridians and circles of latitude
  spiral,   ///< a sheet rolled up, its turns a fraction of an element apart
};
constexpr int kFamilies = 8;
const char* name(Family family);

/// Degrees 2 to 5 (mixed), one in two rational; elements of 1e-4 to 1e3 [length] in any direction, one
/// surface in three 1e3 elements away from the origin.
struct TrialSurface {
  Surface surface;
  Family family;
  double element;  ///< typical size [length]
  Vector3 centre;  ///< of the unmoved shape: on the axis of the exact ones
};
TrialSurface random_surface(shapes::Random& random, Family family);

enum class Place {
  close,   ///< at 1e-6 to 1 element from a point of the surface
  bulk,    ///< some elements away: beyond the centres of curvature, inside closed shapes
  far,     ///< up to 20 times the size of the surface away
  edge,    ///< beyond an edge
  corner,  ///< beyond a corner
  line,    ///< close to a C0 line, a knot line or a pole
  centre,  ///< on a centre of principal curvature, or up to 1e-5 of its radius beside it
};
constexpr int kPlaces = 7;
const char* name(Place place);
Vector3 random_point(shapes::Random& random, const TrialSurface& trial, Place place);

/// `xi` moved by `elements` of its own elements in a random direction, kept in the domain.
Parameter<2> guess_beside(shapes::Random& random, const Space<2>& space, const Parameter<2>& xi,
                          double elements);

}  // namespace nurbs::trials
