// SPDX-License-Identifier: GPL-2.0-or-later
// How far a point may move until its feet are others.
#include <algorithm>
#include <cmath>

#include "brep/edge_foot.h"
#include "brep/foot_search.h"
#include "brep/minima.h"

namespace brep {

double FootSearch::feet_for_a_while(const Vector3& d, double reach, double room, const int* pieces, int count,
                                    std::vector<Foot>& out) const {
  const auto begin = static_cast<std::ptrdiff_t>(out.size());
  Minima minima(surface_, same_point_, d, reach + room, out);
  add_feet(minima, d, reach + room, pieces, count);
  room = std::min(room, minima.room_to_choose(neighbours_));
  minima.leave_nearest(neighbours_);
  constexpr double kSoon = 0.1;  // of the room: who is farther is not worth to be looked at in each step
  const auto is_other = [&](const Foot& foot) {
    if (foot.distance < reach || (foot.distance - reach < kSoon * room && may_last(foot))) return false;
    room = std::min(room, foot.distance - reach);
    return true;
  };
  out.erase(std::remove_if(out.begin() + begin, out.end(), is_other), out.end());
  return room;
}

bool FootSearch::may_last(const Foot& foot) const {
  if (foot.status == FootStatus::edge) return !surface_.trimmed();
  return foot.status == FootStatus::interior && surface_.faces[foot.patch].kind != Kind::nurbs;
}

double FootSearch::room_of_feet(const Vector3& d, double reach, double room, const int* pieces, int count,
                                const std::vector<Foot>& feet, int* below) const {
  if (!surface_.trimmed()) return room_on_triangles(d, reach, room, pieces, count, feet, below);
  return std::min(room, room_on_trimmed(d, reach + room, pieces, count, feet, below));
}

// Which feet there are depends on which point of each triangle is the nearest, one of its inside, of a side
// or a corner, and on nothing else as long as d does not pass through a face.
double FootSearch::room_on_triangles(const Vector3& d, double reach, double room, const int* pieces,
                                     int count, const std::vector<Foot>& feet, int* below) const {
  const double far = reach + room;
  size_t found = 0;
  for (size_t k = 0; k < feet.size(); ++k) {
    if (feet[k].status != FootStatus::edge) continue;
    below[k] = feet[k].entity;
    ++found;
  }
  for (const int* number = pieces; number < pieces + count; ++number) {
    const PlaneTriangle& triangle = triangles_[*number];
    if (!triangle.exists()) return 0.0;
    const double height = triangle.over(d).height;
    if (std::abs(height) >= far) continue;
    const PlaneTriangle::Region here = triangle.region(d, surface_.pieces[*number]);
    if (height * height + here.beside * here.beside >= far * far) continue;
    room = std::min(room, here.room);
    if (here.beside > 0.0 || surface_.faces[triangle.face()].outward * height < 0.0) continue;
    const auto foot = std::find_if(feet.begin(), feet.end(), [&](const Foot& f) {
      return f.patch == triangle.face() && f.status == FootStatus::interior;
    });
    if (foot == feet.end()) continue;  // it is too far, or gives way to another
    below[foot - feet.begin()] = *number;
    ++found;
  }
  constexpr double kRoundOff = 4.0;
  return found == feet.size() ? room - kRoundOff * surface_.slack : 0.0;
}

// A foot comes over an edge into a face, or leaves it, where the point is square above the edge; so does the
// foot of the edge begin and end.  How far it is from there changes no faster than it moves, where faces
// stand alike all along.
double FootSearch::room_beside_edge(const Piece& piece, const Vector3& d, double reach) const {
  constexpr double kAsAbove = 1000.0;  // slacks within which Minima looks twice
  const Edge& edge = surface_.edges[piece.edge[0]];
  if (edge.spline() || edge.varies || (!edge.line() && edge.R <= 2.0 * reach)) return 0.0;
  const EdgeFoot foot(edge, d);
  double room = reach;
  for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
    const double* const m = surface_.uses[u].conormal;
    room = std::min(room, std::abs(foot.q[0] * m[0] + foot.q[1] * m[1]));
  }
  return room - kAsAbove * surface_.slack_of_edge(piece.edge[0]);
}

double FootSearch::room_on_trimmed(const Vector3& d, double reach, const int* pieces, int count,
                                   const std::vector<Foot>& feet, int* below) const {
  double room = reach;
  size_t found = 0;
  for (const int* number = pieces; number < pieces + count && room > 0.0; ++number) {
    const Piece& piece = surface_.pieces[*number];
    if (piece.kind == Piece::Kind::edge) room = std::min(room, room_beside_edge(piece, d, reach));
    if (piece.kind == Piece::Kind::edge) continue;
    if (piece.kind != Piece::Kind::trimmed) return 0.0;
    const Face& face = surface_.faces[piece.face];
    const Projection at = face.project(d);
    room = std::min(room, face.distance_of_focus(d));
    if (std::abs(at.height) >= reach) continue;
    if (face.outward * at.height < 0.0) room = std::min(room, std::abs(at.height));
    if (face.outward * at.height < 0.0 || !surface_.domains[piece.face].inside(at.xi)) continue;
    const auto foot = std::find_if(feet.begin(), feet.end(), [&](const Foot& f) {
      return f.patch == piece.face && f.status == FootStatus::interior;
    });
    if (foot == feet.end()) return 0.0;  // one that gives way to another
    below[foot - feet.begin()] = *number;
    ++found;
  }
  return found == feet.size() ? room - 2.0 * border_slack_ : 0.0;
}

}  // namespace brep
