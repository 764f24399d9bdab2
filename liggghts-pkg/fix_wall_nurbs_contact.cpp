// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs: the contacts of one particle, from its feet to forces.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "atom.h"
#include "coupling/force_distribution.h"
#include "fix_wall_nurbs.h"
#include "nurbs/assert.h"
#include "nurbs/curvature.h"
#include "nurbs/surface_normal.h"
#include "update.h"

using namespace LAMMPS_NS;
using contact::ContactMemory;
using contact::ContactSlot;
using contact::ContactTracker;
using contact::TrackedFoot;
using nurbs::Vector3;
using search::SurfaceFoot;

inline Vector3 FixWallNurbs::wall_velocity(const SurfaceFoot& foot, const Vector3& point,
                                           const Vector3& delta) const {
  if (now_.stands) return Vector3::Zero();
  if (now_.deforms) return coupling::FootBasis(surface_, foot.at()).interpolate(exchange_.velocities());
  Vector3 v = frame_.velocity_at(point);
  if (now_.slides) v += structure_.surface_velocity(point, delta.normalized());
  return v;
}

// Whether the centre may come to the surface within one step; a wall that deforms is asked for its velocity
// only where it matters.
inline bool FixWallNurbs::may_cross(int i, const SurfaceFoot& foot) const {
  constexpr double kNear = 0.1;  // of the distance
  return !now_.deforms || Vector3::Map(atom->v[i]).norm() * dt_ + wall_travel_ >= kNear * foot.distance;
}

// A centre that comes to the surface within one step would leave it on the other side; one that was on the
// other side a step ago has done so.
inline void FixWallNurbs::check_crossing(int i, const SurfaceFoot& foot, const Vector3& delta,
                                         const Vector3& v_wall) {
  const double approach = (v_wall - Vector3::Map(atom->v[i])).dot(delta);  // times the distance
  // In this order: the sign of the approach is anyone's guess, for the processor too.
  if (std::abs(approach) * dt_ >= foot.distance * foot.distance &&
      (approach > 0.0 || (approach < 0.0 && !update->setupflag)))
    crossing_.raise(atom->tag[i], atom->radius[i], std::abs(approach) / foot.distance);
}

namespace {

// Of numbers just written one by one: a load of several at once would wait for all stores.
Vector3 number_by_number(const volatile double* x) {
  const double x_0 = x[0], x_1 = x[1], x_2 = x[2];
  return {x_0, x_1, x_2};
}
Vector3 moment(const Vector3& x, const volatile double* f) {
  const double f_0 = f[0], f_1 = f[1], f_2 = f[2];
  return {x[1] * f_2 - x[2] * f_1, x[2] * f_0 - x[0] * f_2, x[0] * f_1 - x[1] * f_0};
}

}  // namespace

inline void FixWallNurbs::take_slot(int i, TrackedFoot& tracked, const Vector3& delta,
                                    const ContactMemory& slots) {
  if (tracked.slot < 0) tracked.slot = slots.empty_slot();
  if (tracked.slot < 0)
    fail_on_this_rank(
        fmt::format("particle {} touches the wall in more than {} places at step {}; use 'contacts N' "
                    "with a larger N",
                    atom->tag[i], slots.slot_count(), update->ntimestep));
  // The side changes where the branch goes on to another patch, and where the centre passes the surface.
  constexpr double kDeep = 0.5;  // of the radius
  ContactSlot slot = slots.slot(tracked.slot);
  int side = slot.empty() || slot.foot().patch != tracked.foot.patch ? 0 : slot.side();
  if (side == 0 || tracked.foot.distance < kDeep * atom->radius[i]) side = side_of(tracked.foot, delta);
  slot.set_foot(tracked.foot.at(), side);
}

int FixWallNurbs::side_of(const SurfaceFoot& foot, const Vector3& delta) const {
  const Vector3 normal = foot.status == search::ProjectionStatus::interior
                             ? nurbs::shape_at(surface_, exchange_.positions(), foot.at()).normal
                             : nurbs::normal_at(surface_, exchange_.positions(), foot.at());
  return normal.dot(frame_.rotation.transpose() * delta) < 0.0 ? -1 : 1;
}

// A centre on the surface has no direction of its own: it is moved off along the normal, by so little that
// the overlap does not feel it, to the side where it is as far as round-off tells, else to the one that its
// branch came from, else out of a solid, else against its velocity.
Vector3 FixWallNurbs::leave_surface(int i, TrackedFoot& tracked, const Vector3& delta,
                                    const ContactMemory& slots) const {
  constexpr double kRoundOff = 1e-5;  // of the resolution
  constexpr double kOff = 1e-9;       // of the radius
  SurfaceFoot& foot = tracked.foot;
  const Vector3 normal = frame_.rotation * nurbs::normal_at(surface_, exchange_.positions(), foot.at());
  double side = normal.dot(delta);
  if (std::abs(side) <= kRoundOff * resolution_) side = 0.0;
  if (side == 0.0 && tracked.slot >= 0 && slots.slot(tracked.slot).foot().patch == foot.patch)
    side = slots.slot(tracked.slot).side();
  if (side == 0.0) side = outward_sign_[foot.patch];
  if (side == 0.0) {
    const Vector3 x(atom->x[i]);
    side = normal.dot(wall_velocity(foot, x, normal) - Vector3::Map(atom->v[i]));
  }
  // What the models make of the overlap must be this distance to the last bit.
  const double r = atom->radius[i];
  foot.distance = r - (r - std::max(foot.distance, kOff * r));
  return side < 0.0 ? Vector3(-foot.distance * normal) : Vector3(foot.distance * normal);
}

void FixWallNurbs::fail_on_contact(int i, const SurfaceFoot& foot) const {
  const Vector3 x(atom->x[i]), F(atom->f[i]), v(atom->v[i]);
  fail_on_this_rank(fmt::format(
      "the contact of particle {} is not finite at step {}: centre ({:.6g}, {:.6g}, {:.6g}), {:.6g} from the "
      "wall, radius {:.6g}, velocity ({:.6g}, {:.6g}, {:.6g}), force ({:.6g}, {:.6g}, {:.6g}); use a smaller "
      "timestep, or look at the material and at what has changed the particle",
      atom->tag[i], update->ntimestep, x[0], x[1], x[2], foot.distance, atom->radius[i], v[0], v[1], v[2],
      F[0], F[1], F[2]));
}

inline void FixWallNurbs::apply_contact(int i, TrackedFoot& tracked, const Vector3& delta,
                                        const Vector3& v_wall) {
  const SurfaceFoot& foot = tracked.foot;
  NURBS_ASSERT(0 <= i && i < atom->nlocal, i, atom->nlocal);
  NURBS_ASSERT(0 <= tracked.slot && tracked.slot < memory(i).slot_count(), tracked.slot);
  const Vector3 x(atom->x[i]), point = x - delta;

  // The models add to the particle's force; a force of zero before shows what they add.
  Eigen::Map<Vector3> f(atom->f[i]), torque(atom->torque[i]);
  const Vector3 f_before = f, torque_before = torque;
  f.setZero();
  torque.setZero();
  call_contact_model(i, foot, delta, memory(i).slot(tracked.slot), v_wall);
  const Vector3 F = number_by_number(atom->f[i]), T = number_by_number(atom->torque[i]);
  const Vector3 wall_torque = -(T + moment(x, atom->f[i]));
  if (!std::isfinite(F.sum() + T.sum())) fail_on_contact(i, foot);
  f = f_before + F;
  torque = torque_before + T;

  const double overlap = atom->radius[i] - foot.distance;
  if (overlap < 0.0 && F.isZero(0.0)) return;
  const nurbs::SurfacePoint at = foot.at();
  if (now_.needs_forces) {
    const Vector3 on_body = -(frame_.rotation.transpose() * F);
    contacts_.push_back(
        {atom->tag[i], tracked.slot, at.patch, {at.xi[0], at.xi[1]}, {on_body[0], on_body[1], on_body[2]}});
  }
  LocalRow& row = local_rows_.emplace_back();
  row.tag = atom->tag[i];
  row.patch = at.patch;
  row.xi[0] = at.xi[0], row.xi[1] = at.xi[1];
  Vector3::Map(row.point) = point;
  Vector3::Map(row.force) = -F;
  row.overlap = overlap;
  Vector3::Map(row.torque) = wall_torque;
  // The wall feels -F at the foot and what is left of the torque.
  row.power = now_.stands ? 0.0 : F.dot(v_wall) - (wall_torque + point.cross(F)).dot(frame_.angular_velocity);
  row.slot = tracked.slot;

  if (output_) tell_output(i, at, delta, F, v_wall);

  if (inside_body(foot, delta)) inside_.raise(atom->tag[i], atom->radius[i], Vector3::Map(atom->v[i]).norm());
}

// LIGGGHTS' contact models take one radius for the lever arm and the stiffness.  With another effective
// radius r*, the arm r - overlap/2 is kept by turning the particle faster or slower in the same proportion.
inline void FixWallNurbs::call_contact_model(int i, const SurfaceFoot& foot, const Vector3& delta,
                                             ContactSlot slot, Vector3 v_wall) {
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
  const nurbs::SurfaceShape shape = nurbs::shape_near(surface_, exchange_.positions(), foot.at());
  const double r = atom->radius[i];
  const double side = shape.normal.dot(frame_.rotation.transpose() * delta) < 0.0 ? -1.0 : 1.0;
  double product = 1.0;
  for (const double curvature : shape.curvature) product *= std::max(1.0 - side * curvature * r, kLeast);
  return std::max(r / std::sqrt(product), r - 0.5 * foot.distance);  // never less than the overlap
}

inline bool FixWallNurbs::inside_body(const SurfaceFoot& foot, const Vector3& delta) const {
  const int sign = outward_sign_[foot.patch];
  if (sign == 0 || foot.status != search::ProjectionStatus::interior) return false;
  return sign * side_of(foot, delta) < 0;
}

// `delta`, from a foot to the particle's centre, is in space from here on; feet stay in the frame.
void FixWallNurbs::resolve_contacts(const ContactTracker::Query& query) {
  const int i = candidates_.candidates()[query.candidate].particle;
  const ContactMemory slots = memory(i);
  for (TrackedFoot& tracked : tracker_.feet(query, slots)) {
    const SurfaceFoot& foot = tracked.foot;
    const bool touches = foot.distance <= atom->radius[i] || foot.distance < query.touch_reach;
    const Vector3 from_foot = query.centre - foot.foot;
    Vector3 delta = now_.is_turned ? Vector3(frame_.rotation * from_foot) : from_foot;
    if (foot.distance <= resolution_) delta = leave_surface(i, tracked, delta, slots);
    Vector3 v_wall;
    if (touches || may_cross(i, foot)) {
      v_wall = wall_velocity(foot, Vector3::Map(atom->x[i]) - delta, delta);
      check_crossing(i, foot, delta, v_wall);
    }
    if (touches) {
      take_slot(i, tracked, delta, slots);
      apply_contact(i, tracked, delta, v_wall);
    } else if (tracked.slot >= 0) {
      slots.slot(tracked.slot).clear();
      tracked.slot = -1;
    }
  }
}
