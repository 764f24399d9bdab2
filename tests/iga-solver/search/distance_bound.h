// SPDX-License-Identifier: GPL-2.0-or-later
// The judge of the closest-point searches: distance of a point from a NURBS surface by branch and bound.
// It shares nothing with them but the data types: elements become homogeneous Bezier nets by knot insertion,
// nets are halved by de Casteljau's rule, and what cannot hold a nearer point is dropped.  No iteration has
// to converge for a result to hold; what is dropped is dropped for good reason.
//
// "No point of this net is nearer to d than b" is, with Q = w (S - d), the statement that the polynomial
// g = Q.Q - b^2 w^2 is nowhere negative.  Three sufficient conditions are tried, cheapest first:
//   a plane at distance b from d that has all control points beyond it (convex hull);
//   no negative Bernstein coefficient of g (Cargo & Shisha 1966, "The Bernstein form of a polynomial");
//   g convex, by the Bernstein coefficients of its second derivatives, with a tangent plane nowhere negative.
#pragma once

#include <vector>

#include "bezier_net.h"

namespace nurbs::judge {

/// A point of the surface, and its distance from d [length].
struct Nearest {
  Parameter<2> xi;
  double distance;
  int nets;  ///< looked at
};

/// What the first and second derivatives of phi = |S - d|^2 / 2 say about xi, the worst over 32 directions
/// into each element that touches it.  Directions are measured in elements: one step crosses a control net of
/// length L (at least 1e-3 of the longest), and the derivatives are divided by L and L^2.
struct LocalConditions {
  double slope;      ///< least first derivative: negative where phi falls [length]
  double curvature;  ///< least second derivative of the directions without a clear slope [-]
};

class DistanceBound {
 public:
  explicit DistanceBound(const Surface& surface);

  /// Round-off of lengths: what evaluating the surface where it lies cannot avoid [length].
  double round_off() const { return round_off_; }

  /// `known` (a point of the surface), or a nearer one.  Nothing is nearer than (1 - tolerance) times the
  /// result, less round_off().  Throws std::runtime_error if a million nets do not settle it.
  Nearest nearest(const Vector3& d, const Nearest& known, double tolerance) const;
  /// The same, knowing nothing.
  Nearest nearest(const Vector3& d, double tolerance) const;

  /// S(xi), by the Bezier net that holds xi.
  Vector3 point(const Parameter<2>& xi) const;
  /// Of xi taken as the foot of d; all of a pole (an edge that is one point) counts as touched.
  LocalConditions conditions(const Vector3& d, const Parameter<2>& xi) const;

 private:
  Net seen_from(const Vector3& d, const Net& net) const;
  void add_conditions(const Vector3& d, const Net& net, const Vector2& t, LocalConditions& worst) const;

  std::vector<Net> nets_;  // of the elements, relative to origin_
  Vector3 origin_;
  double round_off_;
  double longest_;  // control polygon of an element
  Vector2 parameter_round_off_;
};

}  // namespace nurbs::judge
