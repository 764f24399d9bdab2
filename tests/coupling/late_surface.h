// SPDX-License-Identifier: GPL-2.0-or-later
// A structure whose surface is seen as it was some steps ago, as by a coupling that exchanges positions after
// the forces: what the port's contract rules out, so that tests can show what it would cost.
#pragma once

#include <deque>
#include <memory>
#include <stdexcept>
#include <utility>

#include "coupling/structure_solver.h"

namespace test {

class LateSurface final : public coupling::StructureSolver {
 public:
  using NodalVectors = coupling::NodalVectors;

  LateSurface(std::unique_ptr<coupling::StructureSolver> solver, int steps)
      : solver_(std::move(solver)), steps_(steps) {
    if (steps < 1) throw std::invalid_argument("LateSurface: expected 1 step or more");
    see();
  }

  const NodalVectors& positions() const override { return past_.front().first; }
  const NodalVectors& velocities() const override { return past_.front().second; }
  void begin_step() override {
    solver_->begin_step();
    see();
  }
  void load(const std::vector<double>& state) override {
    solver_->load(state);
    past_.clear();
    see();
  }

  // The solver's own.
  const std::vector<coupling::NodeId>& nodes() const override { return solver_->nodes(); }
  bool is_in_parts() const override { return solver_->is_in_parts(); }
  Eigen::Index owned_node_count() const override { return solver_->owned_node_count(); }
  const coupling::ContactSurface& surface() const override { return solver_->surface(); }
  coupling::RigidFrame frame() const override { return solver_->frame(); }
  void begin_run() override { solver_->begin_run(); }
  void initialise_forces(const coupling::NodalForces& forces) override { solver_->initialise_forces(forces); }
  void end_step(const coupling::NodalForces& forces) override { solver_->end_step(forces); }
  void set_time_step(double dt) override { solver_->set_time_step(dt); }
  double stable_time_step() const override { return solver_->stable_time_step(); }
  bool moves() const override { return solver_->moves(); }
  double kinetic_energy() const override { return solver_->kinetic_energy(); }
  double strain_energy() const override { return solver_->strain_energy(); }
  coupling::Work work() const override { return solver_->work(); }
  coupling::Vector3 linear_momentum() const override { return solver_->linear_momentum(); }
  coupling::Vector3 angular_momentum(const coupling::Vector3& about) const override {
    return solver_->angular_momentum(about);
  }
  std::vector<coupling::SurfaceMaterial> materials() const override { return solver_->materials(); }
  std::optional<coupling::Vector3> gravity() const override { return solver_->gravity(); }
  std::vector<coupling::Probe> probes() const override { return solver_->probes(); }
  std::vector<double> save() const override { return solver_->save(); }
  coupling::Fingerprint fingerprint() const override { return solver_->fingerprint(); }

 private:
  void see() {
    past_.emplace_back(solver_->positions(), solver_->velocities());
    if (past_.size() > steps_ + 1) past_.pop_front();
  }

  std::unique_ptr<coupling::StructureSolver> solver_;
  const std::size_t steps_;
  std::deque<std::pair<NodalVectors, NodalVectors>> past_;  // positions and velocities, the oldest first
};

}  // namespace test
