// SPDX-License-Identifier: GPL-2.0-or-later
// Shapes with known closed forms, and random ones, for the tests of the geometry kernel.
#pragma once

#include <random>
#include <vector>

#include "nurbs/patch.h"

namespace nurbs::shapes {

using Random = std::mt19937;
double uniform(Random& random, double low, double high);
/// Up to 0.3 beside the unit square, up to 0.6 above and below it.
Vector3 point_near_square(Random& random);

/// A curve in the (rho, z) half-plane.
struct Profile {
  KnotVector knots;
  std::vector<double> rho, z, weight;
};
Profile line(double rho, double height);
/// A quarter circle about (centre, 0) from (centre + radius, 0) to (centre, radius).
Profile quarter_arc(double centre, double radius);

/// The profile turned about the z axis by `arcs` quadratic rational arcs of `arc_angle` each [rad]: direction
/// 0 is the azimuth (from the x axis), direction 1 the profile; every arc spans one unit of xi and ends in a
/// C0 knot.
Surface revolve(const Profile& profile, double arc_angle, int arcs = 1);

/// Parameter in [0, 1] of the point at `angle` on one quadratic rational arc from 0 to `arc_angle`.
double arc_parameter(double angle, double arc_angle);

/// A knot vector with a random grading and random interior multiplicities from 1 to the degree.
KnotVector random_knots(Random& random, int degree, int elements);

/// Random weights from 0.5 to 2.
std::vector<double> random_weights(Random& random, int count);

/// A patch of random degrees, knots, weights and control points in the unit box.
template <int Dim>
Patch<Dim> random_patch(Random& random, int max_degree, int elements, bool rational);

/// A bumpy graph over the unit square: control points on the Greville grid, heights up to +-`height`.
Surface random_hills(Random& random, const std::array<KnotVector, 2>& knots, double height, bool rational);

/// A parameter inside the domain.
template <int Dim>
Parameter<Dim> random_parameter(Random& random, const Space<Dim>& space) {
  Parameter<Dim> xi;
  for (int d = 0; d < Dim; ++d) xi[d] = uniform(random, space.knots(d).front(), space.knots(d).back());
  return xi;
}

}  // namespace nurbs::shapes
