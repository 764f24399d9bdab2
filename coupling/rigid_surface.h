// SPDX-License-Identifier: GPL-2.0-or-later
// A fixed surface behind the port: takes any force, never moves.
#pragma once

#include "coupling/structure_solver.h"

namespace coupling {

class RigidSurface final : public StructureSolver {
 public:
  /// Patches whose edges coincide are welded.  `outward_sign` as in ContactSurface; empty: two-sided.
  explicit RigidSurface(const std::vector<nurbs::Surface>& patches, std::vector<int> outward_sign = {});

  const ContactSurface& surface() const override { return surface_; }
  const NodalVectors& positions() const override { return positions_; }
  const NodalVectors& velocities() const override { return velocities_; }

  void initialise_forces(const NodalVectors&) override {}
  void begin_step() override {}
  void end_step(const NodalVectors&) override {}
  void set_time_step(double) override {}
  double stable_time_step() const override;

  bool moves() const override { return false; }
  bool deforms() const override { return false; }
  Eigen::VectorXd control_node_mass() const override { return {}; }
  double kinetic_energy() const override { return 0.0; }
  double strain_energy() const override { return 0.0; }
  Vector3 linear_momentum() const override { return Vector3::Zero(); }
  Vector3 angular_momentum(const Vector3&) const override { return Vector3::Zero(); }
  std::optional<SurfaceMaterial> material() const override { return std::nullopt; }
  std::vector<Probe> probes() const override { return {}; }
  std::vector<double> save() const override { return {}; }
  void load(const std::vector<double>& state) override;

 private:
  RigidSurface(nurbs::PatchedSurface surface, std::vector<int> outward_sign);

  ContactSurface surface_;
  NodalVectors positions_, velocities_;
};

}  // namespace coupling
