// SPDX-License-Identifier: GPL-2.0-or-later
// The point of an edge that is nearest to a point, and the wedge of space that the latter is in.
#pragma once

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

 private:
  bool on_axis() const { return rho_ <= 1e-12 * edge_.R; }

  const Edge& edge_;
  double x_, y_, along_, rho_ = 0.0;  // of d, in the edge's own axes
};

/// The use of an edge at which the wedge begins that q is in.
int use_at_wedge(const Surface& surface, const Edge& edge, const double* q);
/// The same for a direction w from a vertex, beside this ray.
int use_at_wedge_of_ray(const Surface& surface, int ray, const Vector3& w);

}  // namespace brep
