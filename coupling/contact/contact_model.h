// SPDX-License-Identifier: GPL-2.0-or-later
// What a contact model is asked, and who else hears of contacts.
#pragma once

#include <limits>

#include "nurbs/multi_patch.h"
#include "nurbs/surface_slopes.h"

namespace contact {

using nurbs::Vector3;

/// What a contact is corrected by (compliance.h), while it is answered.
struct ContactCorrection {
  /// Of the force what is not the law's own.
  Vector3 further_force() const { return tangents * follows + tilt; }

  /// Of this step, beside that of the velocities; springs add it to their stretch [length].
  Vector3 further_slip = Vector3::Zero();
  nurbs::Tangents tangents = nurbs::Tangents::Zero();  ///< S_j of the patch, in space [length]
  /// How far the contact's own force has moved where the surface is met, in space [length].
  Vector3 shift = Vector3::Zero();
  /// Of the force what an energy has that changes with the foot: parts along the S_j [force/length].
  Eigen::Vector2d follows = Eigen::Vector2d::Zero();
  /// Of what is spread about the foot (spread_weight.h): how much of it, how far the body has that from the
  /// foot, in space [length], and a part of the force that is not, as the normal is not that of the foot
  /// alone.
  double spread = 0.0;
  Vector3 beside = Vector3::Zero();
  Vector3 tilt = Vector3::Zero();
  double stiffness = 0.0;      ///< of the law alone [force/length]
  double tangent = 0.0;        ///< d(force)/d(overlap) [force/length]
  double dashpot = 0.0;        ///< of damping, by the particle's speed alone [force time/length]
  double shear_tangent = 0.0;  ///< along the surface [force/length]
  double shear_dashpot = 0.0;  ///< along the surface, of the particle's speed [force time/length]
};

/// One contact in one step, in space.  Those of a step are written and read once each: what few of them need
/// is elsewhere.
struct Contact {
  Contact() {}               // not set to zero first
  int particle;              ///< of this rank, in this step
  int tag;                   ///< of the particle
  int slot;                  ///< of the particle's memory
  bool touches;              ///< overlap >= 0; else a gap, within the reach of models with cohesion
  bool inside;               ///< the centre is inside the body
  nurbs::SurfacePoint foot;  ///< on the wall
  double distance;           ///< from the foot to the centre; < 0: behind a skin that has one side [length]
  double overlap;            ///< the particle's radius less the distance [length]
  double effective_radius;   ///< of the pair; the particle's own unless the wall's curvature counts [length]
  Vector3 centre;            ///< of the particle [length]
  Vector3 delta;             ///< from the foot to the centre [length]
  Vector3 wall_velocity;     ///< at the foot [length/time]
  double* history;           ///< what the model keeps of this contact, in this step; null if it keeps nothing
  double missing;            ///< share of the force, as MeshEstimate has it; 0 where there is none [-]
  ContactCorrection* correction;  ///< null: none; gone with the step

  Vector3 normal() const {
    return delta / distance;
  }  ///< out of the wall: a centre behind it is to come back

  // The model's answer:
  Vector3 force;   ///< on the particle [force]
  Vector3 torque;  ///< likewise, about its centre [force length]
};

/// A law of contact, normal and tangential: a DEM code's own, or a spring.
class ContactModel {
 public:
  virtual ~ContactModel() = default;
  /// Answers all of a batch, in this order; a particle may be there more than once.
  virtual void evaluate(Contact* contacts, int count) = 0;
  /// K / sqrt(r*) [pressure] of a particle whose elastic force is K x^(3/2), as Hertz' 4/3 E*; not a number
  /// of other laws.
  virtual double hertz_constant(int /*particle*/) const { return std::numeric_limits<double>::quiet_NaN(); }
  /// D / r*^(1/4) [force time/length^(3/2)] of such a particle whose damping is D x^(1/4) dx/dt.
  virtual double hertz_damping(int /*particle*/) const { return 0.0; }
  /// A spring along the surface of such a contact, as Mindlin's, that is kept from step to step: stiffness /
  /// (r* overlap)^(1/2) [pressure]; 0: there is none.
  virtual double shear_constant(int /*particle*/) const { return 0.0; }
  /// Its stretch [length].
  virtual Vector3 shear_stretch(const Contact& /*contact*/) const { return Vector3::Zero(); }
  /// How fast the particle's surface slides over the foot [length/time]; what is along the normal does not
  /// count.
  virtual Vector3 slip(const Contact& /*contact*/) const { return Vector3::Zero(); }
  /// Hears of what has come to the forces that it gave a batch, for its own records: of each contact that has
  /// a correction what follows its foot, and its tilt.
  virtual void hear_of_corrections(const Contact* /*contacts*/, int /*count*/) {}
};

/// Hears of contacts that touch or have a force, after they have it.
class ContactObserver {
 public:
  virtual ~ContactObserver() = default;
  virtual void see(const Contact& contact) = 0;
};

}  // namespace contact
