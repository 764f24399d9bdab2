// SPDX-License-Identifier: GPL-2.0-or-later
// The point of an edge that is nearest to a point, and the wedge of space that the latter is in.
#pragma once

#include "brep/surface.h"

namespace brep {

struct EdgeFoot {
  EdgeFoot(const Edge& edge, const Vector3& d);

  double q[2];    ///< d from the foot, in the plane across the edge [length]
  Vector3 point;  ///< of the whole line or circle
  double t;       ///< along the edge, of arcs to the nearer end beyond
  double beyond;  ///< how far it is beyond an end, 0 or less inside [length]

  double distance2() const { return q[0] * q[0] + q[1] * q[1]; }
  bool beyond_ends(double slack) const { return beyond > slack; }
};

/// The use of an edge at which the wedge begins that q is in.
int use_at_wedge(const Surface& surface, const Edge& edge, const double* q);
/// The same for a direction w from a vertex, beside this ray.
int use_at_wedge_of_ray(const Surface& surface, int ray, const Vector3& w);

}  // namespace brep
