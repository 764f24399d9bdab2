// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts after Hertz with a meshed body whose mesh gives way under them (coupling/local_compliance.h).  The
// law's own overlap x is what is left of the geometric one when the mesh's part is taken off,
//
//   x - c F = overlap,   F = K x^(3/2),
//
// so the two in series are stiffer than the law, by 1 / (1 - s), s = c dF/dx.  Their potential,
// 2/5 K x^(5/2) - 1/2 c F^2, changes with the foot, too: a force -1/2 F^2 grad c along the surface belongs to
// it, without which a contact that slides over elements is not conservative.  A law with damping keeps x from
// step to step (damped_approach.h), springs along the surface what the mesh gives way there
// (shear_compliance.h).
#pragma once

#include <optional>
#include <vector>

#include "coupling/contact/contact_model.h"
#include "coupling/contact/damped_approach.h"
#include "coupling/contact/mesh_estimate.h"
#include "coupling/contact/particle_view.h"
#include "coupling/contact/shear_compliance.h"
#include "coupling/contact/wall.h"
#include "coupling/local_compliance.h"

namespace contact {

/// Overlap of a law F = K x^(3/2) behind a compliance c [length/force], and s = 3/2 c K x^(1/2) there.
struct CorrectedOverlap {
  double x, s, root;  // x^(1/2)
};
/// Newton's method from x = overlap > 0, monotone for either sign of c; where s comes to `limit` on the way,
/// it is left there, and at the solution it is no smaller.
CorrectedOverlap corrected_overlap(double overlap, double c, double K, double limit);

/// The same with a damper beside the law whose force is that of DampedApproach::Damper; `s` is what both give
/// way, c (dF/dx), and `x` less than 0 where the damper alone pulls.
struct DampedOverlap {
  double x, s, force;  // [force]
};
DampedOverlap damped_overlap(double overlap, const DampedLaw& law, const DampedApproach::Damper& damper,
                             double limit);

class ComplianceCorrection {
 public:
  /// Up to this s a point force will do, as the mesh cannot tell it from the contact's disc (theory.md); near
  /// 1 there is no equilibrium.
  static constexpr double kLargest = 0.9;

  /// Keeps references to all.  `mesh`: null if nothing is known of it, which then gives way at once.
  ComplianceCorrection(coupling::LocalCompliance& compliance, const Wall& wall, const MeshEstimate* mesh)
      : compliance_(compliance), wall_(wall), mesh_(mesh) {}

  /// Numbers that a contact keeps behind those of the model, in each slot of the particles' memory.
  static constexpr int kMemory = DampedApproach::kMemory + ShearCompliance::kMemory;
  struct Time {
    long step;
    double dt;      ///< [time]
    bool is_setup;  ///< nothing has moved
  };
  /// Gives contacts the overlaps, and the rates of overlap, that the model shall see.  Throws
  /// std::runtime_error: particle, place, step, if s is too large; std::logic_error if there is no room in
  /// the memory.
  void before(const ParticleView& particles, const Time& now, const ContactModel& model, Contact* begin,
              Contact* end);
  /// Takes the model's answers (`particles`, `model`: as before): contacts are what they were, forces
  /// have their part along the surface, and Contact::tangent and Contact::dashpot are known.
  void after(const ParticleView& particles, const ContactModel& model, Contact* begin, Contact* end);
  /// How far a particle's surface may be from its feet while a contact in one of these slots goes on
  /// [length].
  static double held_gap(const ParticleSlots& slots, int history_count);

 private:
  struct Before {
    double overlap, distance;
    bool touches;
    Vector3 delta, wall_velocity;
    bool has_tangents = false;
    Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::Zero();  // force in units of the tangents [force/length]
    double tangent = 0.0, stiffness = 0.0;            // behind the mesh, and the law's own [force/length]
    double dashpot = 0.0, shear_dashpot = 0.0;        // [force time/length]
    std::optional<ShearCompliance> shear = std::nullopt;
    bool goes_on = false;  // the spring does, in this step
  };
  /// What a law is called with, and what it is to answer.
  struct Seen {
    double x, root;  // x^(1/2)
    double rate;     // of approach [length/time]
    double s;        // where the elastic force is
    double force;    // [force]
    double dashpot;  // [force time/length]
    double damper;   // how stiff it is at once [force/length]
  };
  Seen elastic(double approach, double K, double c, const Contact& contact) const;
  bool damped(const ParticleView& particles, const Time& now, const DampedLaw& law, const Vector3& n,
              double approach, const Contact& contact, Seen& seen) const;
  void correct(const ParticleView& particles, const Time& now, const ContactModel& model, Contact& contact,
               Before& before);
  struct Spring {
    Vector3 n;
    double stiffness;  // along the surface [force/length]
  };
  void correct_shear(const ParticleView& particles, const Time& now, const ContactModel::Shear& shear,
                     const Spring& spring, const coupling::LocalCompliance::Value& c,
                     const SurfaceDirections& directions, Contact& contact, Before& before);

  coupling::LocalCompliance& compliance_;
  const Wall& wall_;
  const MeshEstimate* mesh_;
  std::vector<Before> before_;
};

}  // namespace contact
