// SPDX-License-Identifier: GPL-2.0-or-later
// Homogeneous Bezier nets of a surface's elements: what distance_bound.h works on.  Nothing but data types is
// shared with the evaluation of iga-solver/nurbs.
// Source: Piegl & Tiller (1997), sections 1.4 and 5.3; Ramshaw (1989), "Blossoms are polar forms".
#pragma once

#include "nurbs/patch.h"

namespace nurbs::judge {

using Vector2 = Eigen::Vector2d;

constexpr int kMostCoefficients = 2 * kMaxDegree + 1;  // of the square of a polynomial
double choose(int n, int k);

/// Bezier net on a parameter rectangle: (w x, w y, w z, w) per control point.
struct Net {
  int p, q;                                           ///< degrees in xi and eta
  Vector2 low, high;                                  ///< the rectangle
  Eigen::Vector4d Q[kMaxDegree + 1][kMaxDegree + 1];  ///< [eta][xi]
};

/// The net of one element, relative to `origin`.
Net element_net(const Surface& surface, const Indices<2>& element, const Vector3& origin);
/// Halves across one direction (de Casteljau).
void halve(const Net& net, int direction, Net& left, Net& right);

/// Greatest length of the net's polygons in each direction.
Vector2 lengths(const Net& net);
bool holds(const Net& net, const Vector2& xi);
/// Place of xi (clamped) in the rectangle, which becomes the unit square.
Vector2 local(const Net& net, const Vector2& xi);
/// If xi lies on a side of the net that is one point: the direction that runs along this side; else -1.
int pole_direction(const Net& net, const Vector2& xi);

/// Bernstein polynomials of degree n at t and their first two derivatives, in three columns.
using BernsteinValues = Eigen::Array<double, Eigen::Dynamic, 3, 0, kMostCoefficients, 3>;
BernsteinValues bernstein(int n, double t);

/// The homogeneous point and its derivatives to the second order at t of the unit square:
/// of[i][j] = d^(i+j) Q / dt0^i dt1^j, i + j <= 2.
struct Derivatives {
  Derivatives(const Net& net, const Vector2& t);
  Eigen::Vector4d of[3][3];
};

}  // namespace nurbs::judge
