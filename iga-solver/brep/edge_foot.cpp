// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/edge_foot.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace brep {

Vector3 Edge::point(double t) const {
  if (line()) return origin + t * axis;
  return origin + R * (std::cos(t) * radial + std::sin(t) * axis.cross(radial));
}

Vector3 Edge::tangent(double t) const {
  if (line()) return axis;
  return std::cos(t) * axis.cross(radial) - std::sin(t) * radial;
}

EdgeFoot::EdgeFoot(const Edge& edge, const Vector3& d) : edge_(edge) {
  const Vector3 from = d - edge.origin, across = edge.axis.cross(edge.radial);
  along_ = from.dot(edge.axis);
  x_ = from.dot(edge.radial), y_ = from.dot(across);
  q[0] = x_, q[1] = y_;
  if (edge.line()) return;
  rho_ = std::sqrt(x_ * x_ + y_ * y_);
  q[0] = rho_ - edge.R, q[1] = along_;
}

double EdgeFoot::beyond() const {
  if (edge_.line()) return std::max(-along_, along_ - edge_.length);
  if (edge_.closed() || on_axis()) return 0.0;
  double angle = std::atan2(y_, x_);
  if (angle < 0.0) angle += nurbs::kTwoPi;
  return edge_.R * std::min(angle - edge_.length, nurbs::kTwoPi - angle);
}

Vector3 EdgeFoot::point() const {
  if (edge_.line()) return edge_.origin + along_ * edge_.axis;
  if (on_axis()) return edge_.point(0.5 * edge_.length);
  const double scale = edge_.R / rho_;
  return edge_.origin + scale * (x_ * edge_.radial + y_ * edge_.axis.cross(edge_.radial));
}

int use_at_wedge(const Surface& surface, const Edge& edge, const double* q) {
  for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
    const EdgeUse& use = surface.uses[u];
    const double *m = use.conormal, *n = surface.next_use(edge, u).conormal;
    const double after = m[0] * q[1] - m[1] * q[0], before = q[0] * n[1] - q[1] * n[0];
    if (use.wide ? after >= 0.0 || before >= 0.0 : after >= 0.0 && before >= 0.0) return u;
  }
  return edge.first_use;
}

int use_at_wedge_of_ray(const Surface& surface, int ray, const Vector3& w) {
  const Edge& edge = surface.edges[surface.uses[ray / 2].edge];
  const Vector3 across = edge.axis.cross(edge.radial);
  double q[2] = {w.dot(edge.radial), w.dot(across)};
  if (!edge.line()) {
    const double end = ray % 2 == 0 ? 0.0 : edge.length;
    q[0] = w.dot(std::cos(end) * edge.radial + std::sin(end) * across);
    q[1] = w.dot(edge.axis);
  }
  return use_at_wedge(surface, edge, q);
}

}  // namespace brep
