// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/sector.h"

#include <Eigen/Geometry>
#include <cmath>

#include "brep/edge_uses.h"

namespace brep {

Vector3 ray_direction(const Surface& surface, int ray) {
  const Edge& edge = surface.edges[surface.uses[ray / 2].edge];
  if (edge.spline()) return (ray % 2 == 0 ? 1.0 : -1.0) * at_end(surface, edge, ray % 2).tangent;
  return ray % 2 == 0 ? edge.tangent(0.0) : Vector3(-edge.tangent(edge.length));
}

Sector::Sector(const Surface& surface, const Vertex& vertex, const Corner& corner)
    : whole_(corner.ray[0] < 0), reflex_(corner.reflex) {
  const Face& face = surface.faces[corner.face];
  axis_ = face.frame.z;
  if (face.kind == Kind::nurbs)
    axis_ =
        normal_at(surface, corner.ray[0] / 2,
                  at_end(surface, surface.edges[surface.uses[corner.ray[0] / 2].edge], corner.ray[0] % 2));
  else if (face.kind != Kind::plane)
    axis_ = face.project(vertex.point).normal;
  if (face.kind == Kind::cone && (vertex.point - face.frame.origin).norm() <= 1e-9 * face.high[1]) {
    axis_ = -face.frame.z;
    cos_ = std::cos(face.r), sin_ = std::sin(face.r);
  }
  if (!whole_)
    for (int k = 0; k < 2; ++k) ray_[k] = ray_direction(surface, corner.ray[k]);
}

bool Sector::over(const Vector3& w) const {
  if (whole_) return true;
  const Vector3 across = axis_.cross(w);
  const double after_first = -across.dot(ray_[0]), before_second = across.dot(ray_[1]);  // signs of sines
  if (reflex_) return after_first >= 0.0 || before_second >= 0.0;
  return after_first >= 0.0 && before_second >= 0.0;
}

double Sector::steepest(const Vector3& w, double rays) const {
  if (!over(w)) return rays;
  const double along = w.dot(axis_);
  return -cos_ * along + sin_ * (w - along * axis_).norm();
}

double Sector::height(const Vector3& w) const {
  const double along = w.dot(axis_);
  return cos_ * (w - along * axis_).norm() + sin_ * along;
}

}  // namespace brep
