// SPDX-License-Identifier: GPL-2.0-or-later
// The ways over an edge of a wall, one through each wedge of space round it.
#pragma once

#include <cmath>
#include <vector>

#include "brep/surface.h"

namespace test {

using nurbs::Vector3;

/// Across an edge, from one face to the other through the wedge of space between them.
struct Crossing {
  Vector3 place, u, v;  ///< axes of the plane across
  double from, to;      ///< angles of the faces, counterclockwise from u [rad]
  int face[2];
  brep::Wedge wedge;
  double gap;                                       // tolerance of the edge [mm]
  Vector3 bent;                                     // curvature vector of the edge [1/mm]
  double turn() const { return to - from - M_PI; }  // of the normal; < 0: concave
  Vector3 direction(double angle) const { return std::cos(angle) * u + std::sin(angle) * v; }
};

/// At this part of an edge, those outside of bodies.
std::vector<Crossing> crossings(const brep::Surface& wall, int number, double part);

}  // namespace test
