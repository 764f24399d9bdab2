// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs: the contacts of one particle, from its feet to forces.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "atom.h"
#include "coupling/force_distribution.h"
#include "fix_wall_nurbs.h"
#include "nurbs/curvature.h"
#include "update.h"

using namespace LAMMPS_NS;
using liggghts_pkg::ContactMemory;
using liggghts_pkg::ContactSlot;
using liggghts_pkg::TrackedFoot;
using nurbs::SurfaceFoot;
using nurbs::Vector3;

// `delta`, from a foot to the particle's centre, is in space from here on; feet stay in the frame.
void FixWallNurbs::resolve_contacts(int candidate) {
  const int i = candidates_.candidates()[candidate].particle;
  const Vector3 centre = frame_.to_body(Vector3::Map(atom->x[i]));
  const double reach = touch_reach(i);
  const ContactMemory slots = memory(i);
  for (TrackedFoot& tracked :
       tracker_.feet(candidate, {centre, reach, list_reach_[i], surface_motion_}, slots)) {
    const SurfaceFoot& foot = tracked.foot;
    const Vector3 delta = frame_.rotation * (centre - foot.foot);
    const bool touches = foot.distance <= atom->radius[i] || foot.distance < reach;
    Vector3 v_wall;
    if (touches || may_cross(i, foot)) {
      v_wall = wall_velocity(foot, Vector3::Map(atom->x[i]) - delta, delta / foot.distance);
      check_crossing(i, foot, delta, v_wall);
    }
    if (touches) {
      take_slot(i, tracked, slots);
      apply_contact(i, tracked, delta, v_wall);
    } else if (tracked.slot >= 0) {
      slots.slot(tracked.slot).clear();
      tracked.slot = -1;
    }
  }
}

void FixWallNurbs::take_slot(int i, TrackedFoot& tracked, const ContactMemory& slots) {
  if (tracked.slot < 0) tracked.slot = slots.empty_slot();
  if (tracked.slot < 0)
    fail_on_this_rank(
        fmt::format("particle {} touches the wall in more than {} places at step {}; use 'contacts N' "
                    "with a larger N",
                    atom->tag[i], slots.slot_count(), update->ntimestep));
  slots.slot(tracked.slot).set_foot(tracked.foot.at);
}

Vector3 FixWallNurbs::wall_velocity(const SurfaceFoot& foot, const Vector3& point,
                                    const Vector3& normal) const {
  if (structure_.deforms()) return coupling::FootBasis(surface_, foot.at).interpolate(exchange_.velocities());
  return frame_.velocity_at(point) + structure_.surface_velocity(point, normal);
}

void FixWallNurbs::apply_contact(int i, TrackedFoot& tracked, const Vector3& delta, const Vector3& v_wall) {
  const SurfaceFoot& foot = tracked.foot;
  const Eigen::Map<const Vector3> x(atom->x[i]);
  const Vector3 point = x - delta;

  // The models add to the particle's force; a force of zero before shows what they add.
  Eigen::Map<Vector3> f(atom->f[i]), torque(atom->torque[i]);
  const Vector3 f_before = f, torque_before = torque;
  f.setZero();
  torque.setZero();
  call_contact_model(i, foot, delta, memory(i).slot(tracked.slot), v_wall);
  const Vector3 F = f, T = torque;
  f = f_before + F;
  torque = torque_before + T;

  const double overlap = atom->radius[i] - foot.distance;
  if (overlap < 0.0 && F.isZero(0.0)) return;
  const Vector3 wall_torque = -(T + x.cross(F));
  Vector3::Map(totals_.force) -= F;
  Vector3::Map(totals_.torque) += wall_torque;
  totals_.contacts += 1.0;
  totals_.overlap = std::max(totals_.overlap, overlap);
  // The wall feels -F at the foot and what is left of the torque.
  const Vector3 wall_couple = wall_torque + point.cross(F);
  totals_.power += F.dot(v_wall) - wall_couple.dot(frame_.angular_velocity);

  const nurbs::SurfacePoint& at = foot.at;
  if (structure_.needs_forces()) {
    const Vector3 on_body = -(frame_.rotation.transpose() * F);
    contacts_.push_back(
        {atom->tag[i], tracked.slot, at.patch, {at.xi[0], at.xi[1]}, {on_body[0], on_body[1], on_body[2]}});
  }
  local_rows_.push_back({static_cast<double>(atom->tag[i]),
                         static_cast<double>(at.patch),
                         {at.xi[0], at.xi[1]},
                         {point[0], point[1], point[2]},
                         {-F[0], -F[1], -F[2]},
                         overlap});

  if (output_) tell_output(i, at, delta, F, v_wall);

  if (inside_body(foot, delta)) inside_.raise(atom->tag[i], atom->radius[i], Vector3::Map(atom->v[i]).norm());
}

// LIGGGHTS' contact models take one radius for the lever arm and the stiffness.  With another effective
// radius r*, the arm r - overlap/2 is kept by turning the particle faster or slower in the same proportion.
void FixWallNurbs::call_contact_model(int i, const SurfaceFoot& foot, const Vector3& delta, ContactSlot slot,
                                      Vector3 v_wall) {
  LCM::SurfacesIntersectData contact;
  contact.is_wall = true;
  contact.i = i;
  contact.deltan = atom->radius[i] - foot.distance;
  contact.contact_history = slot.history();
  contact.radi = options_.curvature_radius ? effective_radius(i, foot, delta) : atom->radius[i];
  Vector3::Map(contact.delta) = delta;
  const bool touches = foot.distance <= atom->radius[i];
  if (!options_.curvature_radius) return impl->compute_force(this, contact, touches, v_wall.data());

  const double arm = (atom->radius[i] - 0.5 * contact.deltan) / (contact.radi - 0.5 * contact.deltan);
  Vector3::Map(contact.delta) = (contact.radi - contact.deltan) / foot.distance * delta;
  Eigen::Map<Vector3> omega(atom->omega[i]), torque(atom->torque[i]);
  const Vector3 omega_before = omega;
  omega *= arm;
  impl->compute_force(this, contact, touches, v_wall.data());
  omega = omega_before;
  torque *= arm;
}

// r* = (R' R'')^(1/2) with 1/R = 1/r - curvature of the wall towards the particle, in each principal
// direction: the equivalent radius of Johnson (1985), section 4.2; exact where both are equal, as on a
// sphere.
double FixWallNurbs::effective_radius(int i, const SurfaceFoot& foot, const Vector3& delta) const {
  constexpr double kLeast = 0.1;  // of 1/r: in a hollow of nearly the particle's radius Hertz' theory ends
  const nurbs::SurfaceShape shape = nurbs::shape_at(surface_, exchange_.positions(), foot.at);
  const double r = atom->radius[i];
  const double side = shape.normal.dot(frame_.rotation.transpose() * delta) < 0.0 ? -1.0 : 1.0;
  double product = 1.0;
  for (const double curvature : shape.curvature) product *= std::max(1.0 - side * curvature * r, kLeast);
  return r / std::sqrt(product);
}

bool FixWallNurbs::inside_body(const SurfaceFoot& foot, const Vector3& delta) const {
  const int sign = structure_.surface().outward_sign[foot.at.patch];
  if (sign == 0 || foot.status != nurbs::ProjectionStatus::interior) return false;
  const Vector3 normal = nurbs::shape_at(surface_, exchange_.positions(), foot.at).normal;
  return sign * normal.dot(frame_.rotation.transpose() * delta) < 0.0;
}

// Whether the centre may come to the surface within one step; a wall that deforms is asked for its velocity
// only where it matters.
bool FixWallNurbs::may_cross(int i, const SurfaceFoot& foot) const {
  constexpr double kNear = 0.1;  // of the distance
  return !structure_.deforms() || Vector3::Map(atom->v[i]).norm() * dt_ >= kNear * foot.distance;
}

// A centre that comes to the surface within one step would leave it on the other side.
void FixWallNurbs::check_crossing(int i, const SurfaceFoot& foot, const Vector3& delta,
                                  const Vector3& v_wall) {
  const double approach = (v_wall - Vector3::Map(atom->v[i])).dot(delta) / foot.distance;
  if (approach * dt_ >= foot.distance) crossing_.raise(atom->tag[i], atom->radius[i], approach);
}
