// SPDX-License-Identifier: GPL-2.0-or-later
// The point of an edge that is nearest to a point, and the wedge of space that the latter is in.
#pragma once

#include "brep/edge_uses.h"
#include "brep/surface.h"

namespace brep {

/// On the whole line or circle.
class EdgeFoot {
 public:
  /// Keeps a reference to the edge.
  EdgeFoot(const Edge& edge, const Vector3& d);

  double q[2];  ///< d from the foot, in the plane across the edge [length]
  double distance2() const { return q[0] * q[0] + q[1] * q[1]; }
  /// How far it is beyond the nearer end of the edge, 0 or less inside [length].
  double beyond() const;
  Vector3 point() const;
  /// Tangent, too, and where on the edge it is.
  EdgePoint on_edge() const;

 private:
  bool on_axis() const { return rho_ <= 1e-12 * edge_.R; }

  const Edge& edge_;
  double x_, y_, along_, rho_ = 0.0;  // of d, in the edge's own axes
};

/// The use of an edge at which the wedge begins that q is in.
const EdgeUse& use_at_wedge(const Uses& uses, const double* q);
/// The same for a direction w from a vertex, beside this ray: its number.
int use_at_wedge_of_ray(const Surface& surface, int ray, const Vector3& w);

/// The local minimum of the distance from d on a chunk of a spline, or on its kink with the next: where it
/// is, 0 to 1.  Those not farther than `slack` [length] beyond its ends are there.  False: there is none.
bool minimum_on(const Chunk& chunk, const Vector3& d, double slack, double& s);

}  // namespace brep
