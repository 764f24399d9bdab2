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

void Minima::add_beside_triangle(const Piece& piece) {
  const Vector3& normal = surface_.faces[piece.face].frame.z;
  double least = reach_ * reach_;
  BesideSide beside[3];
  for (int i = 0; i < 3; ++i) {
    const Vector3& corner = surface_.vertices[piece.vertex[i]].point;
    const Vector3 from = d_ - corner, way = surface_.vertices[piece.vertex[(i + 1) % 3]].point - corner;
    if (normal.cross(way).dot(from) >= 0.0) continue;
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
  if (piece.edge[i] >= 0 && before <= leeway && behind <= leeway) add_of_edge(piece.edge[i]);
  if (before >= -leeway) add_of_vertex(piece.vertex[i], piece.face);
  if (behind >= -leeway) add_of_vertex(piece.vertex[(i + 1) % 3], piece.face);
}

void Minima::add_of_face(const Piece& piece) {
  const Face& face = surface_.faces[piece.face];
  if (face.distance_of_whole(d_) >= reach_) return;
  const Projection foot = face.project(d_);
  if (foot.outside <= slack_)
    keep({{foot.xi, foot.point, std::abs(foot.height), FootStatus::interior, 0, piece.face},
          surface_.sheet(piece.face, foot.height < 0.0 ? -1 : 1),
          foot.height < 0.0 ? -1 : 1,
          piece.face});
  if (foot.many && foot.outside <= slack_) return;  // its borders are no nearer
  const Borders& borders = surface_.borders[piece.edge[0]];
  for (int i = 0; i < 4; ++i) {
    if (borders.use[i] >= 0) add_of_edge(borders.use[i]);
    if (borders.vertex[i] >= 0) add_of_vertex(borders.vertex[i], piece.face);
  }
}

void Minima::add_of_edge(int use) {
  const EdgeUse& visiting = surface_.uses[use];
  const Edge& edge = surface_.edges[visiting.edge];
  if (!edge.line() && std::abs(edge.axis.dot(d_ - edge.origin)) >= reach_) return;  // spares a root
  const EdgeFoot foot(edge, d_);
  if (foot.distance2() >= reach_ * reach_ || foot.beyond() > slack_) return;
  const int u = use_at_wedge(surface_, edge, foot.q);
  add_in_wedge(visiting, surface_.uses[u], surface_.next_use(edge, u), foot.q, foot.point());
}

// Of a point where d is square above the face: on a curved one it can be the farthest, beyond the centre.
bool Minima::is_nearest_of_whole(int face, const Vector3& point) const {
  const Face& shape = surface_.faces[face];
  return shape.kind == Kind::plane || (d_ - point).norm() <= (1.0 + kSame) * shape.distance_of_whole(d_);
}

void Minima::add_in_wedge(const EdgeUse& visiting, const EdgeUse& use, const EdgeUse& next, const double* q,
                          const Vector3& point) {
  const auto is_off = [&](const EdgeUse& use_of) {
    const double into = q[0] * use_of.conormal[0] + q[1] * use_of.conormal[1];
    return into < -slack_ || (into <= slack_ && is_nearest_of_whole(use_of.face, point));
  };
  const bool off_use = is_off(use), off_next = is_off(next);
  if (joins(use.wedge)) {
    if (off_use && off_next) add(use.face, use.side, FootStatus::edge, use.edge, point);
    return;
  }
  if (off_use && &visiting == &use) add(use.face, use.side, FootStatus::edge, use.edge, point);
  if (off_next && &visiting == &next) add(next.face, -next.side, FootStatus::edge, use.edge, point);
}

void Minima::add_of_vertex(int v, int face) {
  const Vertex& vertex = surface_.vertices[v];
  const Vector3 w = d_ - vertex.point;
  if (w.squaredNorm() >= reach_ * reach_) return;
  for (int c = vertex.first_corner; c < vertex.first_corner + vertex.corner_count; ++c) {
    const Corner& corner = surface_.corners[c];
    if (corner.face != face) continue;
    for (int s = 0; s < 2; ++s) {
      if (!corner.leads[s] || !in_group(vertex, corner.group[s], w)) continue;
      const Region here = region_of(vertex, w);
      // What is a minimum only on the border, by the slack, is none for any point beside it.
      if (corner.region[s] == here.number && in_group(vertex, corner.group[s], w + here.inward))
        add(face, s == 0 ? 1 : -1, FootStatus::corner, v, vertex.point);
    }
  }
}

// Not uphill along an edge from its end; square above an arc d can be beyond its centre.
bool Minima::is_off_ray(int ray, const Vector3& w) const {
  const double along = ray_direction(surface_, ray).dot(w);
  if (along > slack_) return false;
  const Edge& edge = surface_.edges[surface_.uses[ray / 2].edge];
  return along < -slack_ || edge.line() || w.squaredNorm() <= (1.0 + kSame) * EdgeFoot(edge, d_).distance2();
}

bool Minima::in_group(const Vertex& vertex, int group, const Vector3& w) const {
  for (int c = vertex.first_corner; c < vertex.first_corner + vertex.corner_count; ++c) {
    const Corner& corner = surface_.corners[c];
    if (corner.group[0] != group && corner.group[1] != group) continue;
    for (const int ray : corner.ray)
      if (ray >= 0 && !is_off_ray(ray, w)) return false;
    if (!corner.reflex && surface_.faces[corner.face].kind != Kind::cone) continue;
    if (Sector(surface_, vertex, corner).steepest(w, 0.0) > slack_) return false;
  }
  return true;
}

Minima::Region Minima::region_of(const Vertex& vertex, const Vector3& w) const {
  const Corner* corners = surface_.corners.data() + vertex.first_corner;
  double steepest = -2.0 * w.norm();
  Region region;
  int nearest = -1;
  for (int c = 0; c < vertex.corner_count; ++c) {
    const Sector sector(surface_, vertex, corners[c]);
    for (const int ray : corners[c].ray)
      if (ray >= 0 && ray_direction(surface_, ray).dot(w) > steepest) {
        steepest = ray_direction(surface_, ray).dot(w);
        nearest = ray;
      }
    const double inside = sector.steepest(w, -4.0 * w.norm());
    if (inside < steepest) continue;
    steepest = inside;
    nearest = -1;
    const int side = sector.side(w);
    region.number = corners[c].region[side < 0];
    region.inward.setZero();
    if (std::abs(sector.height(w)) <= slack_) region.inward = 2.0 * side * slack_ * sector.axis();
  }
  if (nearest < 0) return region;
  const int use = use_at_wedge_of_ray(surface_, nearest, w);
  for (int c = 0; c < vertex.corner_count; ++c)
    for (const int ray : corners[c].ray)
      if (ray == 2 * use + nearest % 2) return {corners[c].region[surface_.uses[use].side < 0]};
  return region;
}

void Minima::add(int face, int side, FootStatus status, int entity, const Vector3& point) {
  const Face& shape = surface_.faces[face];
  Parameter<2> xi;
  if (shape.kind == Kind::plane) {
    const Vector3 from = point - shape.frame.origin;
    xi = {from.dot(shape.frame.x), from.dot(shape.frame.y)};
  } else {
    xi = shape.project(point).xi;
  }
  keep({{xi, point, (d_ - point).norm(), status, 0, face}, surface_.sheet(face, side), side, entity});
}

}  // namespace brep
