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

EdgePoint EdgeFoot::on_edge() const {
  if (edge_.line()) return {point(), edge_.axis, along_ / edge_.length};
  double angle = on_axis() ? 0.5 * edge_.length : std::atan2(y_, x_);
  if (angle < 0.0) angle += nurbs::kTwoPi;
  if (angle > edge_.length) angle = angle - edge_.length < nurbs::kTwoPi - angle ? edge_.length : 0.0;
  return {point(), edge_.tangent(angle), angle / edge_.length};
}

const EdgeUse& use_at_wedge(const Uses& uses, const double* q) {
  for (const EdgeUse& use : uses) {
    const double *m = use.conormal, *n = uses.next(use).conormal;
    const double after = m[0] * q[1] - m[1] * q[0], before = q[0] * n[1] - q[1] * n[0];
    if (use.wide ? after >= 0.0 || before >= 0.0 : after >= 0.0 && before >= 0.0) return use;
  }
  return *uses.first;
}

int use_at_wedge_of_ray(const Surface& surface, int ray, const Vector3& w) {
  const UsesAtEnd at = uses_at_end(surface, surface.edges[surface.uses[ray / 2].edge], ray % 2);
  const double q[2] = {w.dot(at.across.u), w.dot(at.across.v)};
  return at.uses.number(use_at_wedge(at.uses, q));
}

// Newton's method between ends at which the distance falls and rises.
bool minimum_on(const Chunk& chunk, const Vector3& d, double slack, double& s) {
  constexpr int kMostSteps = 60;
  constexpr double kLastStep = 1e-8;  // a step that is no longer leaves an error of its square
  const Chunk::End &first = chunk.ends[0], &last = chunk.ends[1];
  const double start = (first.point - d).dot(first.first), end = (last.point - d).dot(last.first);
  const bool at_start = std::abs(start) <= slack * first.first.norm(),
             at_end = std::abs(end) <= slack * last.first.norm();
  if (start < 0.0 && end > 0.0) {
    double low = 0.0, high = 1.0;
    s = start / (start - end);
    for (int k = 0; k < kMostSteps; ++k) {
      const auto c = chunk.curve.derivatives(s);
      const Vector3 from = c.point - d;
      const double g = from.dot(c.first), curvature = c.first.squaredNorm() + from.dot(c.second);
      (g < 0.0 ? low : high) = s;
      double next = curvature > 0.0 ? s - g / curvature : 0.5 * (low + high);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const bool done = std::abs(next - s) <= kLastStep;
      s = next;
      if (done) break;
    }
    return true;
  }
  s = at_start && start >= 0.0 ? 0.0 : 1.0;
  const bool kink = end <= 0.0 && chunk.way_on.dot(last.point - d) >= 0.0 && !chunk.way_on.isZero(0.0);
  return (at_start && start >= 0.0) || (at_end && end <= 0.0) || kink;
}

}  // namespace brep
