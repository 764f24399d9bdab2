// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts_contact_model.h"

#include <Eigen/Geometry>
#include <cmath>

#include "atom.h"
#include "setting.h"

namespace liggghts_pkg {

using contact::Contact;
using nurbs::Vector3;

// The models add to the particle's force.  Meanwhile the rows of that are the contact's, so it gets what they
// add and nothing else.  One `data` serves all, as in LIGGGHTS' own walls.
void LiggghtsContactModel::evaluate(Contact* contacts, int count) {
  LCM::SurfacesIntersectData data;
  data.is_wall = true;
  force_rows_.resize(atom_.nmax);
  torque_rows_.resize(atom_.nmax);
  double **const f = force_rows_.data(), **const torque = torque_rows_.data();
  const Setting<double**> of_force(atom_.f, f), of_torque(atom_.torque, torque);
  TangentialSprings springs = springs_;  // which no model can change
  for (Contact* contact = contacts; contact < contacts + count; ++contact) {
    contact->force.setZero();
    contact->torque.setZero();
    f[contact->particle] = contact->force.data();
    torque[contact->particle] = contact->torque.data();
    if (springs.exist() && contact->touches)
      compute_with_spring(*contact, data, springs);
    else
      compute(*contact, data);
  }
  springs_ = springs;
}

inline void LiggghtsContactModel::compute_with_spring(Contact& contact, LCM::SurfacesIntersectData& data,
                                                      TangentialSprings& springs) {
  const double before = springs.squared_stretch(contact.history);
  if (contact.correction) springs.stretch_by(contact.correction->further_slip, contact.history);
  compute(contact, data);
  springs.add(data.kt, before, springs.squared_stretch(contact.history));
}

inline void LiggghtsContactModel::compute(Contact& contact, LCM::SurfacesIntersectData& data) {
  data.i = contact.particle;
  data.deltan = contact.overlap;
  data.contact_history = contact.history;
  data.radi = contact.effective_radius;
  if (curvature_radius_) return compute_with_effective_radius(contact, data);
  Vector3::Map(data.delta) = contact.delta;
  models_.compute_force(&wall_, data, contact.touches, contact.wall_velocity.data());
}

// LIGGGHTS' contact models take one radius for the lever arm and the stiffness.  With another effective
// radius r*, the arm r - overlap/2 is kept by turning the particle faster or slower in the same proportion.
void LiggghtsContactModel::compute_with_effective_radius(Contact& contact, LCM::SurfacesIntersectData& data) {
  const int i = contact.particle;
  const double arm = (atom_.radius[i] - 0.5 * data.deltan) / (data.radi - 0.5 * data.deltan);
  Vector3::Map(data.delta) = (data.radi - data.deltan) / contact.distance * contact.delta;
  Eigen::Map<Vector3> omega(atom_.omega[i]), torque(atom_.torque[i]);
  const Vector3 omega_before = omega;
  omega *= arm;
  models_.compute_force(&wall_, data, contact.touches, contact.wall_velocity.data());
  omega = omega_before;
  torque *= arm;
}

// Its mass is that of the body that it is part of, as for the models.
double LiggghtsContactModel::hertz_damping(int particle) const {
  if (!constants_.are_known()) return ContactModel::hertz_damping(particle);
  const bool in_body = wall_.fix_rigid() && wall_.body(particle) >= 0;
  const double mass = in_body ? wall_.masstotal(wall_.body(particle)) : atom_.rmass[particle];
  return of_pair(particle).damping * std::sqrt(mass);
}

// As LIGGGHTS' surface models have it.
Vector3 LiggghtsContactModel::slip(const Contact& contact) const {
  const int i = contact.particle;
  const Vector3 n = contact.normal(), omega = Vector3::Map(atom_.omega[i]);
  const double arm = atom_.radius[i] - 0.5 * contact.overlap;
  return Vector3::Map(atom_.v[i]) - contact.wall_velocity + arm * n.cross(omega);
}

// The models store what they answer: store_force.
void LiggghtsContactModel::hear_of_corrections(const Contact* contacts, int count) {
  if (!wall_.store_force()) return;
  for (const Contact* contact = contacts; contact < contacts + count; ++contact)
    if (const contact::ContactCorrection* const by = contact->correction)
      Vector3::Map(wall_.fix_wallforce()->array_atom[contact->particle]) += by->further_force();
}

}  // namespace liggghts_pkg
