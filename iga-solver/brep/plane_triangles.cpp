// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/plane_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace brep {

static_assert(sizeof(PlaneTriangle) == 128, "two cache lines");

PlaneTriangle::PlaneTriangle(const Surface& surface, const Piece& piece) {
  if (!piece.triangle()) return;
  const Frame& frame = surface.faces[piece.face].frame;
  origin_ = frame.origin, x_ = frame.x, y_ = frame.y;
  face_ = piece.face;
  double off = surface.slack;
  for (int i = 0; i < 3; ++i) {
    const Vector3 from = surface.vertices[piece.vertex[i]].point - origin_;
    corner_[i][0] = from.dot(x_), corner_[i][1] = from.dot(y_);
    off = std::max(off, std::abs(from.dot(frame.z)));
  }
  constexpr float kUp = 1.001f;
  leeway_ = kUp * static_cast<float>(off);
}

double PlaneTriangle::from_border(const Vector3& d, const Piece& piece) const {
  const Parameter<2> xi = over(d).xi;
  double least2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    if (piece.edge[i] >= 0) least2 = std::min(least2, squared_distance_from_side(i, xi));
  return std::sqrt(least2);
}

PlaneTriangle::Region PlaneTriangle::region(const Vector3& d, const Piece& piece) const {
  using Point = Eigen::Vector2d;
  constexpr double kNoBorder = std::numeric_limits<double>::infinity();
  const Parameter<2> xi = over(d).xi;
  double in[3], before[3], behind[3];  // of its sides, and how far before and behind their ends
  for (int i = 0; i < 3; ++i) {
    const Point a = Point::Map(corner_[i]), side = Point::Map(corner_[(i + 1) % 3]) - a;
    const double length = side.norm();
    const Point way = side / length, from = Point::Map(xi.data()) - a;
    in[i] = way[0] * from[1] - way[1] * from[0];
    before[i] = -way.dot(from), behind[i] = -before[i] - length;
  }
  const auto border = [&](int i) { return piece.edge[i] < 0 ? kNoBorder : std::abs(in[i]); };
  if (in[0] > 0.0 && in[1] > 0.0 && in[2] > 0.0) return {std::min({border(0), border(1), border(2)}), 0.0};
  for (int i = 0; i < 3; ++i)
    if (in[i] <= 0.0 && before[i] <= 0.0 && behind[i] <= 0.0)
      return {std::min({border(i), -before[i], -behind[i]}), -in[i]};
  for (int i = 0; i < 3; ++i)
    if (before[i] >= 0.0 && behind[(i + 2) % 3] >= 0.0)
      return {std::min(before[i], behind[(i + 2) % 3]), std::hypot(in[i], before[i])};
  return {0.0, 0.0};  // on a border of two, by round-off
}

std::vector<PlaneTriangle> plane_triangles(const Surface& surface) {
  std::vector<PlaneTriangle> triangles;
  triangles.reserve(surface.pieces.size());
  for (const Piece& piece : surface.pieces) triangles.emplace_back(surface, piece);
  return triangles;
}

}  // namespace brep
