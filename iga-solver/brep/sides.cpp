// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/sides.h"

#include <Eigen/Geometry>
#include <cmath>

namespace brep {
namespace {

constexpr double kPole = 1e-9;  // [rad], or of the longest length

bool pole(const Face& face, int end) {
  const double at = end == 0 ? face.low[1] : face.high[1];
  if (face.kind == Kind::cone) return end == 0 && at <= kPole * face.high[1];
  return face.kind == Kind::sphere && std::abs(std::abs(at) - 0.25 * nurbs::kTwoPi) <= kPole;
}

Parameter<2> middle_of_side(const Face& face, int i) {
  const Parameter<2> a = corner_parameters(face, i), b = corner_parameters(face, (i + 1) % 4);
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

// Along xi0 or xi1, of length 1.
Vector3 along(const Face& face, int direction, const Parameter<2>& xi) {
  const Vector3 around = -std::sin(xi[0]) * face.frame.x + std::cos(xi[0]) * face.frame.y;
  return direction == 0 ? around : face.normal(xi).cross(around);
}

Edge line(const Vector3& from, const Vector3& to) {
  Edge edge{};
  edge.origin = from;
  edge.length = (to - from).norm();
  edge.axis = (to - from) / edge.length;
  return edge;
}

// From `from` on, as its normal and its way demand.
Edge arc(const Vector3& centre, const Vector3& from, const Vector3& way, double angle) {
  Edge edge{};
  edge.origin = centre;
  edge.R = (from - centre).norm();
  edge.radial = (from - centre) / edge.R;
  edge.axis = edge.radial.cross(way).normalized();
  edge.length = angle;
  return edge;
}

}  // namespace

bool is_border(const Face& face, int i) {
  if (i % 2 == 1) return !face.whole_turn(0);
  return !face.whole_turn(1) && !pole(face, i == 0 ? 0 : 1);
}

Parameter<2> corner_parameters(const Face& face, int i) {
  return {i == 1 || i == 2 ? face.high[0] : face.low[0], i >= 2 ? face.high[1] : face.low[1]};
}

Side side_at(const Surface& surface, int side) {
  const Piece& piece = surface.pieces[piece_of_side(side)];
  const Face& face = surface.faces[piece.face];
  const int i = side % 4;
  if (piece.triangle()) {
    const Vector3 &a = surface.vertices[piece.vertex[i]].point,
                  &b = surface.vertices[piece.vertex[(i + 1) % 3]].point;
    return {a, face.frame.z.cross(b - a).normalized(), face.frame.z};
  }
  const Parameter<2> xi = middle_of_side(face, i);
  const Vector3 in = along(face, i % 2 == 0 ? 1 : 0, xi);
  return {face.point(xi), i == 0 || i == 3 ? in : Vector3(-in), face.normal(xi)};
}

Edge curve_of(const Surface& surface, int side) {
  const Piece& piece = surface.pieces[piece_of_side(side)];
  const Face& face = surface.faces[piece.face];
  const int i = side % 4;
  if (piece.triangle())
    return line(surface.vertices[piece.vertex[i]].point, surface.vertices[piece.vertex[(i + 1) % 3]].point);
  const Parameter<2> start = corner_parameters(face, i);
  const Vector3 from = face.point(start), z = face.frame.z;
  const Vector3 way = (i < 2 ? 1.0 : -1.0) * along(face, i % 2, start);
  const double turned = i % 2 == 0 ? face.high[0] - face.low[0] : face.high[1] - face.low[1];
  if (i % 2 == 0) return arc(face.frame.origin + (from - face.frame.origin).dot(z) * z, from, way, turned);
  if (face.kind == Kind::sphere) return arc(face.frame.origin, from, way, turned);
  if (face.kind == Kind::torus) return arc(from - face.r * face.normal(start), from, way, turned);
  return line(from, face.point(corner_parameters(face, (i + 1) % 4)));
}

}  // namespace brep
