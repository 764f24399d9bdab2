// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/edge_foot.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace brep {

constexpr double kTurn = 6.283185307179586;

Vector3 Edge::point(double t) const {
  if (line()) return origin + t * axis;
  return origin + R * (std::cos(t) * radial + std::sin(t) * axis.cross(radial));
}

Vector3 Edge::tangent(double t) const {
  if (line()) return axis;
  return std::cos(t) * axis.cross(radial) - std::sin(t) * radial;
}

EdgeFoot::EdgeFoot(const Edge& edge, const Vector3& d) {
  const Vector3 from = d - edge.origin, across = edge.axis.cross(edge.radial);
  if (edge.line()) {
    t = from.dot(edge.axis);
    q[0] = from.dot(edge.radial), q[1] = from.dot(across);
    point = edge.origin + t * edge.axis;
    beyond = std::max(-t, t - edge.length);
    return;
  }
  const double x = from.dot(edge.radial), y = from.dot(across), rho = std::hypot(x, y);
  const bool on_axis = rho <= 1e-12 * edge.R;
  const Vector3 e = on_axis ? edge.point(0.5 * edge.length) - edge.origin
                            : Vector3(edge.R * ((x / rho) * edge.radial + (y / rho) * across));
  point = edge.origin + e;
  q[0] = rho - edge.R, q[1] = from.dot(edge.axis);
  t = on_axis ? 0.5 * edge.length : std::atan2(y, x);
  if (t < 0.0) t += kTurn;
  beyond = edge.closed() ? 0.0 : edge.R * std::min(t - edge.length, kTurn - t);
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
