// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/wall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coupling/force_distribution.h"
#include "nurbs/borders.h"

namespace contact {

namespace {

std::unique_ptr<WallShape> shape_of(const coupling::ContactSurface& given, const nurbs::MultiPatch& surface,
                                    const nurbs::NodalVectors& control_points, double edge_angle) {
  if (given.faces) return std::make_unique<FaceShape>(*given.faces);
  if (given.faced)
    return std::make_unique<FacedPatchShape>(*given.faced, surface, control_points, given.outward_sign);
  return std::make_unique<PatchShape>(surface, control_points, given.outward_sign, edge_angle);
}

bool any_inside(const coupling::ContactSurface& surface) {
  const std::vector<int>& signs = surface.outward_sign;
  return std::any_of(signs.begin(), signs.end(), [](int sign) { return sign != 0; });
}

}  // namespace

Wall::Wall(const coupling::StructureSolver& structure, coupling::SurfaceExchange& exchange, double edge_angle)
    : structure_(structure),
      exchange_(exchange),
      has_inside_(structure.deforms() && any_inside(structure.surface())),
      surface_(structure.surface().topology),
      shape_(shape_of(structure.surface(), surface_, exchange.positions(), edge_angle)),
      patches_(dynamic_cast<const PatchShape*>(shape_.get())) {
  if (knows_masses()) largest_inverse_mass_ = exchange_.inverse_masses().maxCoeff();
}

void Wall::weld_across(const std::vector<Vector3>& periods) {
  const coupling::ContactSurface& surface = structure_.surface();
  if (surface.faces || surface.faced) return;  // their tracker sees seams itself
  std::vector<Vector3> in_frame;
  for (const Vector3& period : periods) in_frame.push_back(structure_.frame().direction_to_body(period));
  if (in_frame == welded_across_) return;
  welded_across_ = in_frame;
  constexpr double kTolerance = 1e-9;
  surface_.set_borders(nurbs::find_borders(nurbs::split(surface_, control_points()), kTolerance, in_frame));
  shape_->begin_list(true);  // it depends on the borders
}

void Wall::import() {
  frame_ = structure_.frame();
  deforms_ = structure_.deforms();
  slides_ = structure_.slides();
  needs_forces_ = structure_.needs_forces();
  is_turned_ = !frame_.rotation.isIdentity(0.0);
  turns_ = !frame_.angular_velocity.isZero(0.0);
  stands_ = !deforms_ && !slides_ && frame_.velocity.isZero(0.0) && !turns_;
  if (!imported_) return import_all();
  if (!deforms_) return;
  exchange_.import_followed();
  shape_->changed();
}

void Wall::import_all() {
  if (imported_ && !deforms_) return;
  exchange_.import_surface();
  shape_->changed();
  imported_ = true;
}

void Wall::begin_list() {
  if (deforms_) import_all();
  shape_->begin_list(deforms_);
  bounds_ = shape_->bounds();
  constexpr double kResolution = 1e-10;  // of the wall's coordinates, which feet know to about 1e-16
  resolution_ = kResolution * bounds_.low.cwiseAbs().cwiseMax(bounds_.high.cwiseAbs()).maxCoeff();
}

double Wall::max_speed() const {
  if (structure_.deforms()) return std::sqrt(exchange_.velocities().colwise().squaredNorm().maxCoeff());
  return frame_.max_speed(bounds_);
}

Vector3 Wall::velocity_of_deforming(const Foot& foot) const {
  return coupling::FootBasis(surface_, foot.at()).interpolate(exchange_.velocities());
}

int Wall::side_of(const Foot& foot, const Vector3& delta) const {
  return shape_->normal_at(foot).dot(to_frame_direction(delta)) < 0.0 ? -1 : 1;
}

Vector3 Wall::leave(Foot& foot, const Vector3& delta, int known_side, double radius, const Vector3& x,
                    const Vector3& v) const {
  constexpr double kRoundOff = 1e-5;  // of the resolution
  constexpr double kOff = 1e-9;       // of the radius
  const Vector3 normal = to_space_direction(shape_->normal_at(foot));
  double side =
      foot.distance < 0.0 ? 0.0 : normal.dot(delta);  // less than 0: it stays on the side that it had
  if (std::abs(side) <= kRoundOff * resolution_) side = 0.0;
  if (side == 0.0) side = known_side;
  if (side == 0.0) side = shape_->outward_sign(foot.patch);
  if (side == 0.0) side = normal.dot(velocity(foot, x, normal) - v);
  // What the models make of the overlap must be this distance to the last bit.
  foot.distance = radius - (radius - std::max(foot.distance, kOff * radius));
  return side < 0.0 ? Vector3(-foot.distance * normal) : Vector3(foot.distance * normal);
}

double Wall::effective_radius(const Foot& foot, const Vector3& delta, double radius) const {
  constexpr double kLeast = 0.1;  // of 1/r: in a hollow of nearly the particle's radius Hertz' theory ends
  const nurbs::SurfaceShape shape = shape_->shape_near(foot);
  const double front = foot.distance < 0.0 ? -1.0 : 1.0;
  const double side = front * (shape.normal.dot(to_frame_direction(delta)) < 0.0 ? -1.0 : 1.0);
  double product = 1.0;
  for (const double curvature : shape.curvature) product *= std::max(1.0 - side * curvature * radius, kLeast);
  return std::max(radius / std::sqrt(product), radius - 0.5 * foot.distance);  // never less than the overlap
}

}  // namespace contact
