// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/contact_rows.h"

#include <Eigen/Geometry>

namespace contact {

const std::vector<WallContact>& ContactRows::of(const std::vector<Contact>& contacts) {
  if (made_) return rows_;
  rows_.clear();
  for (const Contact& contact : contacts) add(contact);
  made_ = true;
  return rows_;
}

void ContactRows::add(const Contact& contact) {
  const Vector3 &F = contact.force, &x = contact.centre;
  WallContact& row = rows_.emplace_back();
  row.tag = contact.tag;
  row.patch = contact.foot.patch;
  row.xi[0] = contact.foot.xi[0], row.xi[1] = contact.foot.xi[1];
  Vector3::Map(row.point) = x - contact.delta;
  Vector3::Map(row.force) = -F;
  row.overlap = contact.overlap;
  row.missing = contact.missing;
  Vector3::Map(row.torque) = -(contact.torque + x.cross(F));
  row.power = stands_ ? 0.0 : power_of(contact, row);
  row.slot = contact.slot;
}

// The wall feels -F at the foot and what is left of the torque.
double ContactRows::power_of(const Contact& contact, const WallContact& row) const {
  const Vector3 &F = contact.force, left = Vector3::Map(row.torque) + Vector3::Map(row.point).cross(F);
  return F.dot(contact.wall_velocity) - left.dot(angular_velocity_);
}

}  // namespace contact
