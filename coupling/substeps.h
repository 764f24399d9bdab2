// SPDX-License-Identifier: GPL-2.0-or-later
// Particles and a body with time steps of their own, behind the port: one of them takes several steps in one
// of the other's.
//   Particles fast (a slow body): internal forces and loads kick the body at the ends of an outer step of
//   `count` particle steps, contact kicks the nodes of the surface in every particle step, and these move on
//   by their own velocities (r-RESPA, impulse form: Tuckerman, Berne & Martyna 1992, J. Chem. Phys. 97,
//   1990). Structure fast (a thin body): the body takes `count` steps in a particle step, contact kicks it at
//   the ends of these.  Such impulses resonate: the body's fast modes are damped a little and, beside heavy
//   particles, the impulses are spread (spread_impulse.h).
// Both are symmetric, of second order (but for the damping), and keep momentum and the ledger of work to
// round-off; what contacts do to nodes that are held or moved, the supports carry.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/iga_structure.h"
#include "coupling/spread_impulse.h"
#include "coupling/substep_options.h"

namespace coupling {

/// Numbers of the body (energies, momenta, work, probes, histories, saved state) are those at the end of its
/// last own step: with fast particles they stand still within an outer step.
class Substeps final : public StructureSolver {
 public:
  Substeps(std::unique_ptr<IgaStructure> body, SubstepOptions options);

  const ContactSurface& surface() const override { return body_->surface(); }
  const std::vector<NodeId>& nodes() const override { return body_->nodes(); }
  bool is_in_parts() const override { return body_->is_in_parts(); }
  Eigen::Index owned_node_count() const override { return body_->owned_node_count(); }
  /// Of nodes that the surface does not hang on they are those at the end of the body's last own step.
  const NodalVectors& positions() const override { return particles_fast() ? x_ : body_->positions(); }
  /// Within a step those of its middle, as a particle's are: what the surface goes through the step with, and
  /// no half of an impulse of contacts without that of the body's own forces. A law that damps asks then.
  const NodalVectors& velocities() const override {
    return particles_fast() || (is_within_step_ && count_ > 1) ? v_ : body_->velocities();
  }

  void initialise_forces(const NodalForces& forces) override;
  void begin_step() override;
  void end_step(const NodalForces& forces) override;

  /// Of the particles.  Chooses who is fast and by how much where that is left open, for the body as it is
  /// strained now.  Also throws std::invalid_argument if `auto` finds no number that lets nothing grow, and
  /// if dt changes within an outer step.
  void set_time_step(double dt) override;
  double stable_time_step() const override { return body_->stable_time_step(); }
  double stable_time_step_with_contacts() const override {
    return count_ == 1 ? body_->stable_time_step_with_contacts()
                       : StructureSolver::stable_time_step_with_contacts();  // two_masses.h
  }
  std::string describe_step() const override;
  /// With `auto`, where strain has brought the body's stable step down to its own: another number.
  std::string take_change() override { return std::exchange(change_, {}); }
  std::string take_warning() override { return body_->take_warning(); }

  bool moves() const override { return true; }
  NodalVectors inverse_node_mass() const override { return body_->inverse_node_mass(); }
  std::optional<MeshedSolid> solid_below(int patch) const override { return body_->solid_below(patch); }
  double kinetic_energy() const override { return body_->kinetic_energy(); }
  double strain_energy() const override { return body_->strain_energy(); }
  Work work() const override { return body_->work(); }
  Vector3 linear_momentum() const override { return body_->linear_momentum(); }
  Vector3 angular_momentum(const Vector3& about) const override { return body_->angular_momentum(about); }
  std::vector<SurfaceMaterial> materials() const override { return body_->materials(); }
  bool takes_gravity_of_deck() const override { return body_->takes_gravity_of_deck(); }
  void set_gravity(const Vector3& g) override { body_->set_gravity(g); }
  std::optional<Vector3> gravity() const override { return body_->gravity(); }
  std::vector<Probe> probes() const override { return body_->probes(); }
  double truncation() const override { return body_->truncation(); }
  std::vector<Reaction> reactions() const override { return body_->reactions(); }

  /// The body's own state; within an outer step followed by where in it particles stand, and what contacts
  /// have done to the nodes.
  std::vector<double> save() const override;
  void load(const std::vector<double>& state) override;
  Fingerprint fingerprint() const override { return body_->fingerprint(); }

  bool particles_fast() const { return fast_ == SubstepOptions::Fast::particles; }
  int count() const { return count_; }

 private:
  void choose(double dt);
  void take_steps(double dt);
  void choose_again(const NodalForces& forces);
  int particle_steps(double dt) const;
  int structure_steps(double dt) const;
  double heaviest_ratio() const;
  bool needs_spread(double dt);
  void set_impulse(const NodalForces& forces);
  void kick_from_now(const NodalForces& forces);
  void take_contacts(const NodalForces& forces);
  void kick_by_contact();
  void drift_by_contact();
  void end_outer_step();
  void place_surface();

  std::unique_ptr<IgaStructure> body_;
  structure::ExplicitSolver& solver_;
  SubstepOptions options_;
  std::vector<Eigen::Index> surface_nodes_;  // columns of nodal arrays
  SubstepOptions::Fast fast_ = SubstepOptions::Fast::structure;
  int count_ = 1, done_ = 0;  // particle steps of the outer step that are done
  double dt_ = 0.0;           // of the particles
  double stable_ = 0.0;       // of the body, as it was strained when this was chosen
  std::string change_;
  bool spreads_ = false;  // structure fast: impulses are spread
  SpreadImpulse spread_;
  NodalForces F_, no_forces_;
  NodalForces contacts_;         // structure fast: their forces, which F_ has as kicks
  bool is_within_step_ = false;  // of particles, which begins and ends
  // Particles fast: the surface now, and what contacts have added since the outer step began.  Structure
  // fast: where the step began, and how fast it is on the mean.
  NodalVectors x_, v_, du_, dv_;
  NodalVectors J_;  // particles fast: impulse of contacts since then, on what supports hold, too
  NodalVectors a_;  // M^-1 F of contacts now
};

}  // namespace coupling
