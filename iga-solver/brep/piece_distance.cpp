// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/piece_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace brep {

double distance_of_piece(const Surface& surface, int number, const Vector3& d) {
  const Piece& piece = surface.pieces[number];
  const Face& face = surface.faces[piece.face];
  if (!piece.triangle()) return face.distance_of_whole(d);
  const Vector3& n = face.frame.z;
  bool inside = true;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector3& a = surface.vertices[piece.vertex[i]].point;
    const Vector3 way = surface.vertices[piece.vertex[(i + 1) % 3]].point - a, from = d - a;
    if (n.cross(way).dot(from) >= 0.0) continue;
    inside = false;
    const double t = std::clamp(from.dot(way) / way.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (from - t * way).squaredNorm());
  }
  return inside ? std::abs(n.dot(d - face.frame.origin)) : std::sqrt(least);
}

}  // namespace brep
