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
    : surface_(surface), whole_(corner.ray[0] < 0), reflex_(corner.reflex) {
  for (const Pole& pole : surface.poles)
    if (pole.face == corner.face && (pole.point - vertex.point).norm() <= 10.0 * surface.slack) pole_ = &pole;
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

namespace {

// Parameters on a pole, and the direction that leads off it there.
struct OffPole {
  Parameter<2> xi;
  Vector3 way, normal;
};
OffPole off_pole(const Surface& surface, const Pole& pole, double part) {
  OffPole off;
  for (int i = 0; i < 2; ++i) off.xi[i] = pole.from[i] + part * (pole.to[i] - pole.from[i]);
  const int along = pole.from[0] != pole.to[0] ? 0 : 1, patch = surface.faces[pole.face].patch;
  const nurbs::KnotVector& knots = surface.patches->patch(patch).space.knots(1 - along);
  const double inwards = off.xi[1 - along] < 0.5 * (knots.front() + knots.back()) ? 1.0 : -1.0;
  off.way = inwards * surface.patches->tangent(patch, off.xi, 1 - along).normalized();
  off.normal = surface.patches->shape(patch, off.xi).normal;
  return off;
}

}  // namespace

// From the steepest of some ways to the steepest beside it.
double Sector::steepest_off_pole(const Vector3& w, double rays, double& part) const {
  constexpr int kWays = 64, kThirds = 60;
  const auto slope = [&](double at) { return w.dot(off_pole(surface_, *pole_, at).way); };
  int best = 0;
  for (int k = 1; k <= kWays; ++k)
    if (slope(static_cast<double>(k) / kWays) > slope(static_cast<double>(best) / kWays)) best = k;
  double low = std::max(0.0, (best - 1.0) / kWays), high = std::min(1.0, (best + 1.0) / kWays);
  for (int k = 0; k < kThirds; ++k) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    const bool first = slope(a) > slope(b);
    (first ? high : low) = first ? b : a;
  }
  part = 0.5 * (low + high);
  const bool at_ray = part < 1e-9 || part > 1.0 - 1e-9;
  return at_ray && !whole_ ? rays : slope(part);
}

double Sector::steepest(const Vector3& w, double rays) const {
  double part;
  if (pole_ != nullptr) return steepest_off_pole(w, rays, part);
  if (!over(w)) return rays;
  const double along = w.dot(axis_);
  return -cos_ * along + sin_ * (w - along * axis_).norm();
}

double Sector::height(const Vector3& w) const {
  if (pole_ != nullptr) {
    double part;
    steepest_off_pole(w, 0.0, part);
    return w.dot(off_pole(surface_, *pole_, part).normal);
  }
  const double along = w.dot(axis_);
  return cos_ * (w - along * axis_).norm() + sin_ * along;
}

}  // namespace brep
