// SPDX-License-Identifier: GPL-2.0-or-later
// A body of an outside code (structure_plugin.h) behind the port.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "coupling/plugin/plugin_library.h"
#include "coupling/plugin/plugin_skin.h"
#include "coupling/structure_solver.h"
#include "coupling/substep_options.h"

namespace coupling {

/// What the plug-in returns as an error, or gives that is not finite, is FailedOnThisRank: the ranks do not
/// ask each other in every step.
class PluginStructure final : public StructureSolver {
 public:
  /// `skin` as the description says.  Collective.  Throws std::invalid_argument, the same on every rank.
  PluginStructure(MPI_Comm comm, std::unique_ptr<PluginBody> body,
                  const StructurePluginDescription& description, PluginSkin skin, std::string surface);

  const ContactSurface& surface() const override { return *surface_; }
  const std::vector<NodeId>& nodes() const override { return skin_.own; }
  bool is_in_parts() const override { return in_parts_; }
  const NodalVectors& positions() const override { return x_; }
  /// With sub-steps, within a step: those of its middle, as a particle's are.
  const NodalVectors& velocities() const override { return is_within_step_ && count_ > 1 ? v_mean_ : v_; }

  void initialise_forces(const NodalForces& forces) override;
  void begin_step() override;
  void end_step(const NodalForces& forces) override;

  /// Also throws if dt, or with sub-steps its part, is above the stable step, naming both numbers.
  void set_time_step(double dt) override;
  double stable_time_step() const override;
  double stable_time_step_with_contacts() const override;
  /// `structure N|auto`: that many steps of its own in one of the particles, contacts kick it at the ends.
  bool take_substeps(const SubstepOptions& options) override;
  std::string describe_step() const override;

  bool moves() const override { return true; }
  NodalVectors inverse_node_mass() const override { return skin_.inverse_mass; }
  double kinetic_energy() const override { return totals().kinetic_energy; }
  double strain_energy() const override { return totals().strain_energy; }
  /// That of contacts is worked out here, that of internal forces is what the balance leaves.
  Work work() const override;
  double truncation() const override;
  Vector3 linear_momentum() const override { return Vector3::Map(totals().linear_momentum); }
  Vector3 angular_momentum(const Vector3& about) const override;
  std::vector<SurfaceMaterial> materials() const override { return materials_; }
  bool takes_gravity_of_deck() const override { return body_->functions().set_gravity != nullptr; }
  void set_gravity(const Vector3& g) override;
  /// Its loads are its own business.
  std::optional<Vector3> gravity() const override { return Vector3(Vector3::Zero()); }
  std::vector<Probe> probes() const override { return {}; }

  std::vector<double> save() const override;
  void load(const std::vector<double>& state) override;
  Fingerprint fingerprint() const override;

 private:
  void take_motion(const char* after);
  NodalVectors of_all_nodes(const NodalVectors& own) const;
  /// The half kick by contacts that has taken velocities to those of now [energy].
  double work_of_half_kick(const NodalVectors& before) const;
  StructurePluginTotals totals() const;

  MPI_Comm comm_;
  std::unique_ptr<PluginBody> body_;
  PluginSkin skin_;
  bool in_parts_;
  std::string surface_name_, identity_;
  std::vector<SurfaceMaterial> materials_;
  NodalVectors x_, v_;
  NodalVectors x_before_, v_mean_;  // where a step of several began, and how fast it is on the mean
  bool is_within_step_ = false;     // of particles, which begins and ends
  std::optional<ContactSurface> surface_;
  FingerprintPart geometry_;  // as it was opened
  NodalVectors F_;            // contact forces of the last step, times count_
  std::vector<Eigen::Index> touched_;
  NodalVectors no_forces_, v_before_;
  bool has_substeps_ = false;
  std::optional<int> wanted_count_;      // nothing: as many as the stable step asks for
  int count_ = 1, count_of_forces_ = 1;  // those that the body has now
  double dt_ = 0.0;                      // of the particles
  double stable_ = 0.0;                  // at the beginning of the step
  double contact_work_ = 0.0;            // of this rank's nodes
  double kinetic_start_ = 0.0, strain_start_ = 0.0;
};

}  // namespace coupling
