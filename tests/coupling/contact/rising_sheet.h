// SPDX-License-Identifier: GPL-2.0-or-later
// The smallest structure that deforms, for tests of contact.
#pragma once

#include <limits>
#include <numeric>
#include <vector>

#include "coupling/structure_solver.h"

namespace test {

using nurbs::Vector3;

/// A sheet whose control points rise at a speed: to contact, a body that deforms.
class RisingSheet final : public coupling::StructureSolver {
 public:
  RisingSheet(const nurbs::Surface& sheet, double speed, int outward_sign = 0)
      : surface_{nurbs::join({sheet}).topology,
                 coupling::SurfaceMap::identity(sheet.control_points.cols()),
                 {outward_sign}},
        positions_(sheet.control_points),
        velocities_(Vector3(0, 0, speed).replicate(1, positions_.cols())),
        nodes_(positions_.cols()) {
    std::iota(nodes_.begin(), nodes_.end(), 0);
  }
  const coupling::ContactSurface& surface() const override { return surface_; }
  const std::vector<coupling::NodeId>& nodes() const override { return nodes_; }
  const coupling::NodalVectors& positions() const override { return positions_; }
  const coupling::NodalVectors& velocities() const override { return velocities_; }
  void begin_step() override { positions_ += dt_ * velocities_; }
  void set_time_step(double dt) override { dt_ = dt; }
  bool moves() const override { return true; }
  /// A control point is nowhere from now on.
  void lose(int control_point) { positions_(1, control_point) = std::numeric_limits<double>::quiet_NaN(); }
  // What contact does not ask for:
  void initialise_forces(const coupling::NodalForces&) override {}
  void end_step(const coupling::NodalForces&) override {}
  double stable_time_step() const override { return 1.0; }
  coupling::NodalVectors inverse_node_mass() const override { return inverse_mass; }
  double stable_time_step_with_contacts() const override { return stable_step; }
  coupling::LocalCompliance* local_compliance() const override { return compliance; }
  double kinetic_energy() const override { return 0.0; }
  double strain_energy() const override { return 0.0; }
  Vector3 linear_momentum() const override { return Vector3::Zero(); }
  Vector3 angular_momentum(const Vector3&) const override { return Vector3::Zero(); }
  std::vector<coupling::SurfaceMaterial> materials() const override { return {}; }
  std::vector<coupling::Probe> probes() const override { return {}; }
  std::vector<double> save() const override { return {}; }
  void load(const std::vector<double>&) override {}
  coupling::Fingerprint fingerprint() const override { return {}; }

  coupling::NodalVectors inverse_mass;
  double stable_step = std::numeric_limits<double>::infinity();
  coupling::LocalCompliance* compliance = nullptr;

 private:
  coupling::ContactSurface surface_;
  coupling::NodalVectors positions_, velocities_;
  std::vector<coupling::NodeId> nodes_;
  double dt_ = 0.0;
};

}  // namespace test
