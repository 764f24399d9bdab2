// SPDX-License-Identifier: GPL-2.0-or-later
// iga-solver's explicit solid behind the port.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/mesh_compliance.h"
#include "coupling/structure_solver.h"
#include "nurbs/boundary.h"
#include "parallel/shared_fields.h"
#include "parallel/shared_history.h"
#include "structure/conditions/probe.h"
#include "structure/time/explicit_solver.h"

namespace coupling {

class IgaStructure final : public StructureSolver {
 public:
  /// Particles see the given pieces of the body's skin; pieces that share an edge are welded there.
  /// `in_parts`: every rank has a solver of a part of its own; then all is collective.
  IgaStructure(structure::ExplicitSolver solver, std::vector<structure::SkinPiece> skin,
               std::vector<structure::Probe> probes = {}, const std::optional<Vector3>& gravity = {},
               bool in_parts = false);
  /// Supports whose reactions are asked for.
  void watch(std::vector<structure::NamedSupport> supports);
  /// From now on contacts are corrected by what its mesh gives way.
  void correct_contacts(std::unique_ptr<MeshCompliance> compliance);
  /// From now on writes histories; before the first run.
  void write_history(parallel::SharedHistory history) { history_.emplace(std::move(history)); }
  /// The same for fields.
  void write_fields(parallel::SharedFields fields) { fields_.emplace(std::move(fields)); }

  structure::ExplicitSolver& solver() { return solver_; }
  const std::vector<structure::Probe>& watched_points() const { return probes_; }
  const std::vector<structure::NamedSupport>& watched_supports() const { return named_supports_; }
  /// Of a body that somebody else moves (modal_structure.h): writes what is due at a time, of the solver as
  /// `place` leaves it, a row of the histories as `amend` does.
  void write_output(double time, double step, const std::function<void()>& place,
                    const std::function<void(io::HistoryRow& row)>& amend);

  const ContactSurface& surface() const override { return surface_; }
  const std::vector<NodeId>& nodes() const override { return nodes_; }
  bool is_in_parts() const override { return in_parts_; }
  Eigen::Index owned_node_count() const override {
    return solver_.halo().owned(static_cast<Eigen::Index>(nodes_.size()));
  }
  const NodalVectors& positions() const override { return solver_.positions(); }
  const NodalVectors& velocities() const override { return solver_.velocities(); }

  void initialise_forces(const NodalForces& forces) override;
  void begin_step() override { solver_.begin_step(); }
  void end_step(const NodalForces& forces) override;
  /// Also throws if dt is above the stable step, naming both numbers.
  void set_time_step(double dt) override;
  double stable_time_step() const override { return solver_.stable_time_step(); }
  double stable_time_step_with_contacts() const override { return solver_.stable_time_step_now(); }
  std::string take_warning() override { return solver_.take_warning(); }
  LocalCompliance* local_compliance() const override { return compliance_.get(); }

  bool moves() const override { return true; }
  NodalVectors inverse_node_mass() const override { return solver_.mass().inverse_mass(); }
  double kinetic_energy() const override { return solver_.kinetic_energy(); }
  double strain_energy() const override { return solver_.strain_energy(); }
  Work work() const override;
  Vector3 linear_momentum() const override { return solver_.linear_momentum(); }
  Vector3 angular_momentum(const Vector3& about) const override { return solver_.angular_momentum(about); }
  std::vector<SurfaceMaterial> materials() const override;
  std::optional<MeshedSolid> solid_below(int patch) const override;
  /// From now on set_gravity adds to the loads that there are.
  void take_gravity_of_deck() { load_without_gravity_ = solver_.load(); }
  bool takes_gravity_of_deck() const override { return load_without_gravity_.size() > 0; }
  void set_gravity(const Vector3& g) override;
  std::optional<Vector3> gravity() const override { return gravity_; }
  std::vector<Probe> probes() const override;
  double truncation() const override { return solver_.truncation(solver_.strain_energy()); }
  std::vector<Reaction> reactions() const override;
  /// The solver's; where local compliances follow strain and have done so theirs, and how many numbers these
  /// are.
  std::vector<double> save() const override;
  void load(const std::vector<double>& state) override;
  std::size_t state_size() const override;
  Fingerprint fingerprint() const override;

 private:
  void write_output();

  structure::ExplicitSolver solver_;
  std::vector<structure::SkinPiece> skin_;
  std::vector<NodeId> nodes_;
  bool in_parts_;
  FingerprintPart supports_;
  std::optional<FingerprintPart> springs_;
  ContactSurface surface_;
  double mass_;
  std::unique_ptr<MeshCompliance> compliance_;
  std::vector<structure::Probe> probes_;
  std::vector<structure::NamedSupport> named_supports_;
  std::optional<Vector3> gravity_;
  NodalVectors load_without_gravity_;  // if that is the deck's
  std::optional<parallel::SharedHistory> history_;
  std::optional<parallel::SharedFields> fields_;
};

}  // namespace coupling
