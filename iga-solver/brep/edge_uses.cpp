// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/edge_uses.h"

#include <Eigen/Geometry>

namespace brep {
namespace {

constexpr double kFlatAngle = 1e-9;  // [rad]

// Straight between the two guides around it.
Parameter<2> guess(const std::array<Parameter<2>, Surface::kGuides>& guides, double part) {
  const double place = part * (Surface::kGuides - 1);
  const int k = std::clamp(static_cast<int>(place), 0, Surface::kGuides - 2);
  const double beyond = place - k;
  return {guides[k][0] + beyond * (guides[k + 1][0] - guides[k][0]),
          guides[k][1] + beyond * (guides[k + 1][1] - guides[k][1])};
}

}  // namespace

Across across(const Edge& edge, const Vector3& point) {
  if (edge.line()) return {edge.radial, edge.axis.cross(edge.radial)};
  const Vector3 from = point - edge.origin;
  return {(from - from.dot(edge.axis) * edge.axis).normalized(), edge.axis};
}

Across across(const Vector3& tangent) {
  int least;
  tangent.cwiseAbs().minCoeff(&least);
  const Vector3 u = tangent.cross(Vector3::Unit(least)).normalized();
  return {u, tangent.cross(u)};
}

Meeting meeting(const Side& side, const Across& across, int face, int edge) {
  Meeting meeting{};
  double* m = meeting.use.conormal;
  m[0] = side.conormal.dot(across.u), m[1] = side.conormal.dot(across.v);
  const double length = std::hypot(m[0], m[1]);
  m[0] /= length, m[1] /= length;
  meeting.use.face = face;
  meeting.use.edge = edge;
  meeting.use.side = side.normal.dot(m[0] * across.v - m[1] * across.u) > 0.0 ? 1 : -1;
  meeting.angle = std::atan2(m[1], m[0]);
  if (meeting.angle < 0.0) meeting.angle += nurbs::kTwoPi;
  return meeting;
}

Wedge wedge_of(double angle, double edge_angle) {
  if (angle > nurbs::kPi + edge_angle) return Wedge::convex;
  if (angle < nurbs::kPi - edge_angle) return Wedge::concave;
  return angle < nurbs::kPi - kFlatAngle ? Wedge::smooth_concave : Wedge::smooth;
}

EdgePoint at_part(const Surface& surface, const Edge& edge, double part) {
  if (!edge.spline()) {
    const double t = part * edge.length;
    return {edge.point(t), edge.tangent(t), part};
  }
  const Chunk* const first = &surface.chunks[edge.first_chunk];
  const double begin = first->curve.begin, end = first[edge.chunk_count - 1].curve.end;
  const double t = begin + part * (end - begin);
  int c = 0;
  while (c + 1 < edge.chunk_count && t >= first[c].curve.end) ++c;
  const BezierCurve<3>& curve = first[c].curve;
  const auto at = curve.derivatives((t - curve.begin) / (curve.end - curve.begin));
  return {at.point, at.first.normalized(), part};
}

EdgePoint at_end(const Surface& surface, const Edge& edge, int end) { return at_part(surface, edge, end); }

Parameter<2> parameters_at(const Surface& surface, int use, const EdgePoint& at) {
  const int patch = surface.faces[surface.uses[use].face].patch;
  return surface.patches->projector(patch).warm(at.point, guess(surface.guides[use], at.part)).xi;
}

Vector3 normal_at(const Surface& surface, int use, const EdgePoint& at) {
  const Face& face = surface.faces[surface.uses[use].face];
  if (face.kind != Kind::nurbs) return face.project(at.point).normal;
  return surface.patches->normal(face.patch, parameters_at(surface, use, at));
}

Side side_at(const Surface& surface, int use, const EdgePoint& at) {
  const Vector3 normal = normal_at(surface, use, at);
  return {at.point, surface.uses[use].along * normal.cross(at.tangent), normal};
}

Uses local_uses(const Surface& surface, const Edge& edge, const EdgePoint& at, const Across& across) {
  struct Local : Meeting {
    int number;
    Local(const Meeting& meeting, int use) : Meeting(meeting), number(use) {}
  };
  thread_local std::vector<Local> met;
  thread_local std::vector<EdgeUse> uses;
  thread_local std::vector<int> numbers;
  met.clear();
  for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
    const EdgeUse& use = surface.uses[u];
    met.emplace_back(meeting(side_at(surface, u, at), across, use.face, use.edge), u);
    met.back().use.along = use.along;
  }
  sort_round(met, surface.edge_angle);
  uses.clear();
  numbers.clear();
  for (const Local& local : met) {
    uses.push_back(local.use);
    numbers.push_back(local.number);
  }
  return {uses.data(), static_cast<int>(uses.size()), numbers.data(), 0};
}

UsesAtEnd uses_at_end(const Surface& surface, const Edge& edge, int end) {
  if (edge.line() && !edge.varies) return {uses_of(surface, edge), across(edge, edge.origin)};
  const EdgePoint at = at_end(surface, edge, end);
  const Across axes = edge.spline() ? across(at.tangent) : across(edge, at.point);
  return {edge.varies ? local_uses(surface, edge, at, axes) : uses_of(surface, edge), axes};
}

}  // namespace brep
