// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/piece_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "brep/edge_foot.h"

namespace brep {

namespace {

// Of a plane face from the rectangle around its loops.
double distance_of_trimmed(const Face& face, const Vector3& d) {
  if (face.kind != Kind::plane) return face.distance_of_whole(d);
  const Projection foot = face.project(d);
  double sum = foot.height * foot.height;
  for (int i = 0; i < 2; ++i) {
    const double off = std::max({face.low[i] - foot.xi[i], foot.xi[i] - face.high[i], 0.0});
    sum += off * off;
  }
  return std::sqrt(sum);
}

double distance_of_edge(const Surface& surface, const Piece& piece, const Vector3& d) {
  const Edge& edge = surface.edges[piece.edge[0]];
  if (edge.spline()) {
    const Chunk& chunk = surface.chunks[edge.first_chunk + piece.chunk()];
    const double ball = (d - chunk.centre).norm() - chunk.radius;
    return std::max({ball, chunk.distance_of_chord(d) - chunk.bulge, 0.0});
  }
  const EdgeFoot foot(edge, d);
  const double beyond = edge.line() ? std::max(foot.beyond(), 0.0) : 0.0;
  return std::sqrt(foot.distance2() + beyond * beyond);
}

double distance_of_other(const Surface& surface, const Piece& piece, const Vector3& d) {
  const Face& face = surface.faces[piece.face];
  switch (piece.kind) {
    case Piece::Kind::trimmed:
      return distance_of_trimmed(face, d);
    case Piece::Kind::element:
      return std::sqrt(surface.patches->hull(face.patch, piece.element()).squared_distance(d));
    case Piece::Kind::edge:
      return distance_of_edge(surface, piece, d);
    case Piece::Kind::vertex:
      return (d - surface.vertices[piece.vertex[0]].point).norm();
    default:
      return face.distance_of_whole(d);
  }
}

}  // namespace

double distance_of_piece(const Surface& surface, int number, const Vector3& d) {
  const Piece& piece = surface.pieces[number];
  if (!piece.triangle()) return distance_of_other(surface, piece, d);
  const Face& face = surface.faces[piece.face];
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
