// SPDX-License-Identifier: GPL-2.0-or-later
// What a step's contacts mean to the wall, a row of numbers each.  Most steps nobody reads them, so they are
// made when they are asked for: then or later, whatever has become of particles and wall meanwhile.
#pragma once

#include <vector>

#include "coupling/contact/contact_model.h"

namespace contact {

/// One contact as the wall feels it: doubles throughout, so that a particle code may hand it on as a row.
struct WallContact {
  WallContact() {}  // not set to zero first
  double tag, patch, xi[2];
  double point[3];   ///< foot [length]
  double force[3];   ///< on the wall [force]
  double overlap;    ///< [length]
  double missing;    ///< share of the force (mesh_estimate.h) [-]
  double torque[3];  ///< on the wall, about the origin [force length]
  double power;      ///< that the wall gives to the particle [energy/time]
  double slot;
};

class ContactRows {
 public:
  /// Contacts are those of a step in which the wall stands, or turns like this [1/time].
  void begin_step(bool stands, const Vector3& angular_velocity) {
    made_ = false;
    stands_ = stands;
    angular_velocity_ = angular_velocity;
  }
  /// In their order.
  const std::vector<WallContact>& of(const std::vector<Contact>& contacts);

 private:
  void add(const Contact& contact);
  double power_of(const Contact& contact, const WallContact& row) const;

  std::vector<WallContact> rows_;
  bool made_ = false, stands_ = true;
  Vector3 angular_velocity_ = Vector3::Zero();
};

}  // namespace contact
