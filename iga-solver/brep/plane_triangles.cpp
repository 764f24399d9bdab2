// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/plane_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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

std::vector<PlaneTriangle> plane_triangles(const Surface& surface) {
  std::vector<PlaneTriangle> triangles;
  triangles.reserve(surface.pieces.size());
  for (const Piece& piece : surface.pieces) triangles.emplace_back(surface, piece);
  return triangles;
}

}  // namespace brep
