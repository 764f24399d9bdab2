// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts after Hertz with a meshed body whose mesh gives way under them (coupling/local_compliance.h).  The
// law's own overlap x is what is left of the geometric one when the mesh's part is taken off,
//
//   x - c F = overlap,   F = K x^(3/2),
//
// so the two in series are stiffer than the law, by 1 / (1 - s), s = c dF/dx.  Their potential,
// 2/5 K x^(5/2) - 1/2 c F^2, changes with the foot, too: a force -1/2 F^2 grad c along the surface belongs to
// it, without which a contact that slides over elements is not conservative.  A law with damping keeps x from
// step to step, too (approach_kernel.h), springs along the surface what the mesh gives way there
// (shear_kernel.h).  The surface is met beside where the mesh has it, by what forces of contacts let the mesh
// give way too much near them (coupling/cross_shift.h); what a contact's own force of the last steps has done
// there is no overlap.  Where elements are so small that s passes 0.5 the force is spread about the foot
// (spread_weight.h).  What they solve is a chain of roots and quotients, so contacts take it side by side.
#pragma once

#include <array>
#include <vector>

#include "coupling/contact/approach_kernel.h"
#include "coupling/contact/contact_model.h"
#include "coupling/contact/mesh_estimate.h"
#include "coupling/contact/particle_view.h"
#include "coupling/contact/shear_kernel.h"
#include "coupling/contact/spread_weight.h"
#include "coupling/contact/surface_directions.h"
#include "coupling/contact/wall.h"
#include "coupling/local_compliance.h"

namespace contact {

class ComplianceCorrection {
 public:
  /// Near s = 1 there is no equilibrium.
  static constexpr double kLargest = 0.9;
  /// How many contacts are corrected together, at most.
  static constexpr int kCapacity = ApproachBlock::kCapacity;

  /// Keeps references to all.  `mesh`: null if nothing is known of it, which then gives way at once.
  ComplianceCorrection(coupling::LocalCompliance& compliance, const Wall& wall, const MeshEstimate* mesh);

  /// Numbers that a contact keeps behind those of the model, in each slot of the particles' memory: its force
  /// as it was expected in the last step, as it was then, and before, and how much of it was spread, and how
  /// far the surface was above the foot then; of its approach, with u as a vector, and whether the body is
  /// light; of its spring along the surface.
  enum Forces {
    kExpected = 0,  // vectors, on the particle
    kLast = 3,
    kBefore = 6,
    kSpreadExpected = 9,  // w
    kSpreadLast,
    kSpreadBefore,
    kAbove,
    kForces
  };
  static constexpr int kLight = ApproachBlock::kU + 3, kApproach = kLight + 1;
  static constexpr int kMemory = kForces + kApproach + ShearBlock::kMemory;
  struct Time {
    long step;
    double dt;      ///< [time]
    bool is_setup;  ///< nothing has moved
  };
  /// Gives contacts the overlaps, and the rates of overlap, that the model shall see.  Throws
  /// std::runtime_error: particle, place, step, if s is too large; std::logic_error if there is no room in
  /// the memory.
  void before(const ParticleView& particles, const Time& now, const ContactModel& model, Contact* contacts,
              int count);
  /// Takes the model's answers (all as before): contacts are what they were, forces have their part along the
  /// surface, and Contact::tangent and Contact::dashpot are known.
  void after(const ParticleView& particles, const Time& now, ContactModel& model, Contact* contacts,
             int count);
  /// Feet of contacts on this rank: what the mesh gives way elsewhere is that of the body as it is strained
  /// now.  Collective.
  bool follows_strain() const { return compliance_.follows_strain(); }
  void follow_strain(const std::vector<nurbs::SurfacePoint>& feet);
  /// How far the surfaces may be apart while a damped contact with this x goes on [length].
  static double held_gap(double x) {
    constexpr double kDent = 10.0;
    return x > 0.0 ? kDent * x : 0.0;
  }
  /// The same of any contact in these slots.
  static double held_gap(const ParticleSlots& slots, int history_count);

 private:
  /// What few contacts need: those whose force is spread.
  struct Spread {
    SpreadWeight weight;
    double mismatch, above;           // mu, q [length]
    Vector3 beside, beside_velocity;  // sums of Z_A x_A, as the body has it, and of Z_A v_A, in space
    nurbs::Tangents beside_slopes;    // and of dZ_A/dxi_j x_A
    coupling::LocalCompliance::Spread give;
  };
  /// What a contact was, and where it is in the blocks.
  struct Before {
    double overlap, distance;
    bool touches, is_corrected;
    double damping;
    Vector3 delta, wall_velocity;
    Vector3 met_velocity;        // of the surface as it is met, by its mean if the force is spread
    const ApproachBlock* block;  // null: not corrected, or over
    int lane, shear_lane;        // shear_lane < 0: no spring along the surface that goes on
    bool has_shear;              // it has one
    bool is_light;               // the body, and the contact damped
    Vector3 n;
    double approach;   // [length/time]
    Vector3 expected;  // its own force on the particle, as the surface has it [force]
    double expected_spread;
    double w;              // how much of it is spread now
    const Spread* spread;  // of a force that is spread, or was
    SurfaceDirections directions;
    coupling::LocalCompliance::Value give;
  };
  /// Of a contact that begins [energy] (approach_kernel.h).
  double credit(const ParticleView& particles, const ContactModel& model, const Contact& contact,
                const Before& before) const;
  void look_at(const ParticleView& particles, const ContactModel& model, const Contact& contact,
               Before& before) const;
  void enter(const ParticleView& particles, const Time& now, const ContactModel& model, Contact& contact,
             Before& before);
  double overlap_of_others(const ParticleView& particles, const Time& now, const Contact& contact,
                           Before& before);
  Spread& know_spread(const Contact& contact, Before& before);
  static SpreadLaw spread_law(const Before& before);
  void spread_damped(const ParticleView& particles, const Time& now, Contact& contact, Before& before);
  void spread_elastic(const ParticleView& particles, const Time& now, Contact& contact, Before& before);
  static void move_with_spread(const ParticleView& particles, const Time& now, Contact& contact,
                               Before& before);
  static Vector3 across(const Vector3& v, const Vector3& n) { return v - n.dot(v) * n; }
  /// What a contact keeps: its forces, of its approach, of its spring.  Throws std::logic_error if there is
  /// no room for it.
  static double* memory_of(const ParticleView& particles, const Contact& contact);
  static double* approach_memory_of(const ParticleView& particles, const Contact& contact) {
    return memory_of(particles, contact) + kForces;
  }
  static double* shear_memory_of(const ParticleView& particles, const Contact& contact) {
    return approach_memory_of(particles, contact) + kApproach;
  }
  static void forget_approach(const ParticleView& particles, const Contact& contact);
  static double give_along(const Before& before, int component, Eigen::Vector2d& gradient);
  static Eigen::Vector2d spread_along(const Contact& contact, const Before& before, double F);
  static void remember(const ParticleView& particles, const Contact& contact, const Before& before);
  void see_overlap(const ParticleView& particles, const Time& now, Contact& contact, Before& before);
  void enter_shear(const ParticleView& particles, const ContactModel& model, const Contact& contact,
                   Before& before);
  void see_slip(const ParticleView& particles, const Time& now, Contact& contact, const Before& before) const;

  coupling::LocalCompliance& compliance_;
  const Wall& wall_;
  const MeshEstimate* mesh_;
  bool has_links_;
  const coupling::NetSpread* net_spread_;  // null: forces are not spread
  bool keeps_forces_;                      // in the memory
  ApproachKernel approach_kernel_;
  ShearKernel shear_kernel_;
  std::array<Before, kCapacity> before_;
  std::array<Spread, kCapacity> spreads_;  // of the same
  ApproachBlock elastic_, damped_;
  ShearBlock shear_;
  int elastic_count_ = 0, damped_count_ = 0, shear_count_ = 0;
};

}  // namespace contact
