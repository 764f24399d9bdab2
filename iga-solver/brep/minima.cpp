// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/minima.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "brep/edge_foot.h"
#include "brep/sector.h"

namespace brep {

constexpr double kSame = 1e-6;  // of two distances that would differ by much
constexpr double kTie = 1e-12;  // sides of a triangle that are nearest alike, relative to a square

void Minima::add_beside_triangle(const Piece& piece, const Vector3& normal) {
  double least = reach_ * reach_;
  BesideSide beside[3];
  for (int i = 0; i < 3; ++i) {
    const Vector3& corner = surface_.vertices[piece.vertex[i]].point;
    const Vector3 from = d_ - corner, way = surface_.vertices[piece.vertex[(i + 1) % 3]].point - corner;
    if (normal.cross(way).dot(from) >= 0.0) continue;
    if (piece.edge[i] >= 0) nurbs::prefetch(surface_.edges[surface_.uses[piece.edge[i]].edge]);
    beside[i] = {from.dot(way), way.squaredNorm(), 0.0};
    beside[i].distance2 =
        (from - std::clamp(beside[i].along / beside[i].length2, 0.0, 1.0) * way).squaredNorm();
    least = std::min(least, beside[i].distance2);
  }
  for (int i = 0; i < 3; ++i)
    if (beside[i].distance2 < reach_ * reach_ && beside[i].distance2 <= least * (1.0 + kTie))
      add_of_side(piece, i, beside[i]);
}

// Near an end to within round-off, the edge and the vertex: the pieces round it may see it as either.
void Minima::add_of_side(const Piece& piece, int i, const BesideSide& beside) {
  const double leeway = slack_ * std::sqrt(beside.length2);
  const double before = -beside.along, behind = beside.along - beside.length2;
  if (piece.edge[i] >= 0 && before <= leeway && behind <= leeway)
    add_of_edge(surface_.uses[piece.edge[i]].edge, piece.edge[i]);
  if (before >= -leeway) add_of_vertex(piece.vertex[i], piece.face);
  if (behind >= -leeway) add_of_vertex(piece.vertex[(i + 1) % 3], piece.face);
}

void Minima::add_of_rectangle(const Piece& piece) {
  const Face& face = surface_.faces[piece.face];
  if (face.distance_of_whole(d_) >= reach_) return;
  const Projection foot = face.project(d_);
  if (foot.outside <= slack_)
    keep({{foot.xi, foot.point, std::abs(foot.height), FootStatus::interior, 0, piece.face},
          surface_.sheet(piece.face, foot.height < 0.0 ? -1 : 1),
          foot.height < 0.0 ? -1 : 1,
          piece.face});
  if (foot.many && foot.outside <= slack_) return;  // its borders are no nearer
  const Borders& borders = surface_.borders[piece.borders()];
  for (int i = 0; i < 4; ++i) {
    if (borders.use[i] >= 0) add_of_edge(surface_.uses[borders.use[i]].edge, borders.use[i]);
    if (borders.vertex[i] >= 0) add_of_vertex(borders.vertex[i], piece.face);
  }
}

void Minima::add_of_edge(int number, int visiting) {
  const Edge& edge = surface_.edges[number];
  if (!edge.line() && std::abs(edge.axis.dot(d_ - edge.origin)) >= reach_) return;  // spares a root
  const EdgeFoot foot(edge, d_);
  const double slack = surface_.slack_of_edge(number);
  if (foot.distance2() >= reach_ * reach_ || foot.beyond() > slack) return;
  if (surface_.guides.empty())  // nobody asks where on the edge it is
    return add_in_wedge(uses_of(surface_, edge), visiting, {{foot.point(), {}, 0.0}, foot.q, slack});
  const EdgePoint at = foot.on_edge();
  const Uses uses =
      edge.varies ? local_uses(surface_, edge, at, across(edge, at.point)) : uses_of(surface_, edge);
  add_in_wedge(uses, visiting, {at, foot.q, slack});
}

// Of a point where d is square above the face: on a curved one it can be the farthest, beyond the centre. The
// edge may be off the face by the slack.
bool Minima::is_nearest_of_whole(const EdgeUse& use, int number, const OnEdge& on) const {
  const Face& shape = surface_.faces[use.face];
  if (shape.kind == Kind::plane) return true;
  if (shape.kind == Kind::nurbs) {
    const Parameter<2> xi = parameters_at(surface_, number, on.at);
    return is_lowest_beside(use.face, xi, (d_ - surface_.patches->point(shape.patch, xi)).norm());
  }
  return (d_ - on.at.point).norm() <= (1.0 + kSame) * shape.distance_of_whole(d_) + on.slack;
}

// Whether a face does not fall towards d from its edge.  Over a face that bends away from it d may be farther
// inside of the border than its foot is.
bool Minima::is_off(const EdgeUse& use, int number, const OnEdge& on) const {
  constexpr double kMostBent = 1000.0;
  const double into = on.q[0] * use.conormal[0] + on.q[1] * use.conormal[1];
  if (into < -on.slack) return true;
  if (into > on.slack && (into > kMostBent * on.slack || !has_foot_beside(use, number, on))) return false;
  return is_nearest_of_whole(use, number, on);
}

// Whether the foot on all of the surface that a face is cut from is no farther inside of the face's border
// than the slack.
bool Minima::has_foot_beside(const EdgeUse& use, int number, const OnEdge& on) const {
  const Face& shape = surface_.faces[use.face];
  if (shape.kind == Kind::plane || !surface_.trimmed()) return false;
  Vector3 foot, normal;
  if (shape.kind == Kind::nurbs) {
    const Parameter<2> xi = parameters_at(surface_, number, on.at);
    foot = surface_.patches->projector(shape.patch).warm(d_, xi).point;
    normal = surface_.patches->normal(shape.patch, xi);
  } else {
    const Projection at = shape.project(d_);
    foot = at.point, normal = at.normal;
  }
  const Vector3 inward = use.along * normal.cross(on.at.tangent);
  return inward.dot(foot - on.at.point) <= on.slack;
}

void Minima::add_in_wedge(const Uses& uses, int visiting, const OnEdge& on) {
  const EdgeUse &use = use_at_wedge(uses, on.q), &next = uses.next(use);
  const int number = uses.number(use), next_number = uses.number(next);
  const bool off_use = is_off(use, number, on), off_next = is_off(next, next_number, on);
  if (on.slack > slack_) widen(on.slack);
  if (visiting == kAll && uses.count > 2) add_square_above(uses, on);
  if (joins(use.wedge)) {
    if (off_use && off_next) add(use.face, use.side, FootStatus::edge, use.edge, on.at, number);
    return;
  }
  if (off_use && (visiting == kAll || visiting == number))
    add(use.face, use.side, FootStatus::edge, use.edge, on.at, number);
  if (off_next && (visiting == kAll || visiting == next_number))
    add(next.face, -next.side, FootStatus::edge, use.edge, on.at, next_number);
}

// Of a trimmed face, what is inside ends at its border: square above an edge of many faces d is over those,
// be it in their wedge or not.  Where its sheet falls on beyond the edge the foot is farther down.
void Minima::add_square_above(const Uses& uses, const OnEdge& on) {
  for (const EdgeUse& use : uses) {
    const double* m = use.conormal;
    if (std::abs(on.q[0] * m[0] + on.q[1] * m[1]) > on.slack ||
        !is_nearest_of_whole(use, uses.number(use), on))
      continue;
    const bool ahead = m[0] * on.q[1] - m[1] * on.q[0] > 0.0;  // in the wedge that begins at the face
    const EdgeUse& other = ahead ? uses.next(use) : uses.before(use);
    if (joins((ahead ? use : other).wedge) && !is_off(other, uses.number(other), on)) continue;
    add(use.face, ahead ? use.side : -use.side, FootStatus::edge, use.edge, on.at, uses.number(use));
  }
}

void Minima::add_of_vertex(int v, int face) {
  const Vertex& vertex = surface_.vertices[v];
  const Vector3 w = d_ - vertex.point;
  if (w.squaredNorm() >= reach_ * reach_) return;
  corner_slack_ = surface_.slack_of_vertex(v);
  if (corner_slack_ > slack_) widen(corner_slack_);
  for (int c = vertex.first_corner; c < vertex.first_corner + vertex.corner_count; ++c) {
    const Corner& corner = surface_.corners[c];
    if (face != kAll && corner.face != face) continue;
    for (int s = 0; s < 2; ++s) {
      if (!corner.leads[s] || !in_group(vertex, corner.group[s], w)) continue;
      const Region& here = known_region_of(v, w);
      // What is a minimum only on the border, by the slack, is none for any point beside it.
      if (corner.region[s] == here.number && in_group(vertex, corner.group[s], w + here.inward))
        add_of_corner(corner, s == 0 ? 1 : -1, v);
    }
  }
}

// Not uphill along an edge from its end; square above an arc d can be beyond its centre, and where ends were
// made one point the whole arc passes that by the slack.
bool Minima::is_off_ray(int ray, const Vector3& w) const {
  const double along = ray_direction(surface_, ray).dot(w);
  if (along > corner_slack_) return false;
  const Edge& edge = surface_.edges[surface_.uses[ray / 2].edge];
  return along < -corner_slack_ || edge.line() ||
         w.norm() <= (1.0 + kSame) * std::sqrt(EdgeFoot(edge, d_).distance2()) + corner_slack_;
}

bool Minima::in_group(const Vertex& vertex, int group, const Vector3& w) const {
  for (int c = vertex.first_corner; c < vertex.first_corner + vertex.corner_count; ++c) {
    const Corner& corner = surface_.corners[c];
    if (corner.group[0] != group && corner.group[1] != group) continue;
    for (const int ray : corner.ray)
      if (ray >= 0 && !is_off_ray(ray, w)) return false;
    const Kind kind = surface_.faces[corner.face].kind;
    if (!corner.reflex && kind != Kind::cone && (kind != Kind::nurbs || surface_.poles.empty())) continue;
    if (Sector(surface_, vertex, corner).steepest(w, 0.0) > corner_slack_) return false;
  }
  return true;
}

const Minima::Region& Minima::known_region_of(int vertex, const Vector3& w) {
  const int known = std::min(region_count_, kRegions);
  for (int k = 0; k < known; ++k)
    if (regions_[k].vertex == vertex) return regions_[k].region;
  KnownRegion& next = regions_[region_count_++ % kRegions];
  next = {vertex, region_of(surface_.vertices[vertex], w)};
  return next.region;
}

Minima::Region Minima::region_of(const Vertex& vertex, const Vector3& w) const {
  const Corner* corners = surface_.corners.data() + vertex.first_corner;
  double steepest = -2.0 * w.norm();
  Region region;
  int nearest = -1;
  for (int c = 0; c < vertex.corner_count; ++c) {
    const Sector sector(surface_, vertex, corners[c]);
    for (int k = 0; k < 2; ++k)
      if (corners[c].ray[k] >= 0 && sector.ray(k).dot(w) > steepest) {
        steepest = sector.ray(k).dot(w);
        nearest = corners[c].ray[k];
      }
    const double inside = sector.steepest(w, -4.0 * w.norm());
    if (inside < steepest) continue;
    steepest = inside;
    nearest = -1;
    const int side = sector.side(w);
    region.number = corners[c].region[side < 0];
    region.inward.setZero();
    if (std::abs(sector.height(w)) <= corner_slack_)
      region.inward = 2.0 * side * corner_slack_ * sector.axis();
  }
  if (nearest < 0) return region;
  const int use = use_at_wedge_of_ray(surface_, nearest, w);
  for (int c = 0; c < vertex.corner_count; ++c)
    for (const int ray : corners[c].ray)
      if (ray == 2 * use + nearest % 2) return {corners[c].region[surface_.uses[use].side < 0]};
  return region;
}

void Minima::add_of_corner(const Corner& corner, int side, int v) {
  const int ray = corner.ray[0];
  const EdgePoint at{surface_.vertices[v].point, {}, static_cast<double>(ray % 2)};
  add(corner.face, side, FootStatus::corner, v, at, ray / 2);
}

void Minima::add(int face, int side, FootStatus status, int entity, const EdgePoint& at, int use) {
  const Face& shape = surface_.faces[face];
  Parameter<2> xi;
  if (shape.kind == Kind::plane) {
    xi = shape.in_plane(at.point);
  } else if (shape.kind == Kind::nurbs) {
    xi = parameters_at(surface_, use, at);
  } else {
    xi = shape.project(at.point).xi;
  }
  keep({{xi, at.point, (d_ - at.point).norm(), status, 0, face}, surface_.sheet(face, side), side, entity});
}

}  // namespace brep
