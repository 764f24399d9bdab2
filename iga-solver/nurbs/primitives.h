// SPDX-License-Identifier: GPL-2.0-or-later
// Patches of simple shapes.  Flat ones are parametrised affinely; round ones are exact, products of rational
// arcs and segments (Piegl & Tiller 1997, sections 7.3 and 8.5).
//
// Every closed surface has its normal dS/dxi x dS/deta pointing outwards, every volume is right-handed.  A
// full turn is closed to the last bit, and a pole (the tip of a cone, an end of a sphere) is one point to the
// last bit; a patch knows nothing of either, so both are edges of its parameter rectangle. All functions
// throw std::invalid_argument for lengths or directions that make no such shape.
#pragma once

#include <vector>

#include "nurbs/patch.h"

namespace nurbs {

/// Axis-parallel block [origin, origin + size] [length], parametrised affinely by the given knot vectors (any
/// domain).
Volume box(const Vector3& origin, const Vector3& size, const std::array<KnotVector, 3>& knots);

/// Parallelogram origin + u edge_u + v edge_v, u, v in [0,1], parametrised affinely; the normal is edge_u x
/// edge_v.
Surface plane(const Vector3& origin, const Vector3& edge_u, const Vector3& edge_v,
              const std::array<KnotVector, 2>& knots);

/// Part of a rolled plate between two lines x = const.
struct Strip {
  double length;                    ///< along x [length]
  std::array<double, 2> thickness;  ///< where it begins and where it ends [length]
  int elements;                     ///< along x; of a ramp an even number, so that its middle is a knot
};
/// A tailor rolled blank: flat below at z = origin.z, the strips following one another along x from
/// origin.x, `width` along y.  A strip between two thicknesses is a C1 ramp of two parabolas, each over half
/// of its length, with no slope at its ends; so the top is C1, piecewise quadratic and exact.
/// Parametrised affinely along x and y, and along z at every x.
/// Throws std::invalid_argument also if strips do not meet in the same thickness, a ramp has an odd number of
/// elements, or degree_x is 1.
Volume rolled_plate(const Vector3& origin, double width, const std::vector<Strip>& strips, int degree_x,
                    const std::array<KnotVector, 2>& across_and_through);

/// Where a round shape stands: z is its axis, and angles count from x to y.
struct Frame {
  Vector3 origin;        ///< [length]
  Eigen::Matrix3d axes;  ///< columns x, y, z: orthonormal, right-handed
};
/// z along `axis` (any length > 0), x along the part of `reference` that is normal to it.
Frame frame(const Vector3& origin, const Vector3& axis, const Vector3& reference);
/// The reference is the coordinate axis that follows the largest component of `axis`: x for an axis along z.
Frame frame(const Vector3& origin, const Vector3& axis);

/// Unit circle about the origin of the xy plane from angle `from` to `to` [degree], on [0, 1]: as few equal
/// quadratic rational arcs as are at most 90 degrees each, joined by C0 knots (the circle itself is smooth
/// there).  Points are off the circle by a few units of the last place.
/// Throws std::invalid_argument unless from < to <= from + 360.
Curve arc(double from, double to);
/// The same curve with `elements` elements of a higher or the same degree: each of its own elements is cut
/// into parts of equal parameter length.  Throws std::invalid_argument unless the number of elements is a
/// multiple of the curve's own.
Curve refined(const Curve& curve, int elements, int degree);

/// Turns a meridian about the frame's axis along `azimuth`, a curve made of arc(); xi is the azimuth, then
/// come the meridian's own directions.  The meridian (a curve or a surface) lies in the plane y = 0, x >= 0
/// being the distance from the axis.  Dim is 1 or 2.
template <int Dim>
Patch<Dim + 1> revolve(const Patch<Dim>& meridian, const Curve& azimuth, const Frame& frame);

// Round shapes, xi = azimuth.  Lengths > 0 unless said; the arcs are made of arc().

/// Frustum without its ends: eta runs along the axis over `length` from the origin, where the radius is
/// `radii[0]`, to the other end with `radii[1]`.  One of the two may be 0: a tip.
Surface cone(const Frame& frame, const std::array<double, 2>& radii, double length, const Curve& azimuth,
             const KnotVector& along);
/// A cone of equal radii.
Surface cylinder(const Frame& frame, double radius, double length, const Curve& azimuth,
                 const KnotVector& along);
/// eta is the latitude, from -90 (south pole) to 90 degrees at most.
Surface sphere(const Frame& frame, double radius, const Curve& longitude, const Curve& latitude);
/// eta turns round the tube, from outside (0 degrees) over the top (90); 0 < tube_radius < radius.
Surface torus(const Frame& frame, double radius, double tube_radius, const Curve& azimuth,
              const Curve& tube_angle);
/// A solid: eta runs along the axis over `length` from the origin, zeta from the inner to the outer radius. A
/// full ring is slit: its faces xi- and xi+ touch; who makes a body of it joins them.
Volume tube(const Frame& frame, double inner_radius, double outer_radius, double length, const Curve& azimuth,
            const std::array<KnotVector, 2>& along_and_through);

}  // namespace nurbs
