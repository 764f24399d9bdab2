// SPDX-License-Identifier: GPL-2.0-or-later
// The smallest particle code there is, for tests of contact: arrays, velocity Verlet, a spring.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupling/contact/contact_loop.h"

namespace test {

using nurbs::Vector3;

constexpr double kRadius = 0.5;  ///< of balls where nothing asks for another

/// Balls of mass 1 with `slots` contacts each, of which the model keeps `history_count` values.
class Balls {
 public:
  explicit Balls(int slots = 2, int history_count = 0) : history_count_(history_count), slots_(slots) {}

  void add(const Vector3& centre, double r, const Vector3& velocity = Vector3::Zero()) {
    tag.push_back(static_cast<int>(tag.size()) + 1);
    mask.push_back(1);
    radius.push_back(r);
    for (int d = 0; d < 3; ++d) x.push_back(centre[d]), v.push_back(velocity[d]);
    f.resize(x.size()), torque.resize(x.size());
    for (std::vector<double>& rows : slots_) {
      rows.push_back(contact::ContactSlot::kEmpty);
      rows.resize(rows.size() + contact::ContactMemory::row_size(history_count_) - 1, 0.0);
    }
  }
  int count() const { return static_cast<int>(tag.size()); }
  Eigen::Map<Vector3> centre(int i) { return Eigen::Map<Vector3>(&x[3 * i]); }
  Eigen::Map<Vector3> velocity(int i) { return Eigen::Map<Vector3>(&v[3 * i]); }
  Vector3 force(int i) const { return Vector3::Map(&f[3 * i]); }

  contact::ParticleView view() {
    rows_.clear();
    mass_.assign(count(), 1.0);
    for (std::vector<double>& rows : slots_) rows_.push_back(rows.data());
    const contact::ContactMemory memory{rows_.data(), static_cast<int>(rows_.size()), history_count_};
    return {count(),     tag.data(), radius.data(), x.data(),    v.data(), f.data(), torque.data(),
            mask.data(), 1,          memory,        mass_.data()};
  }

  std::vector<int> tag, mask;
  std::vector<double> radius, x, v, f, torque;

 private:
  int history_count_;
  std::vector<std::vector<double>> slots_;
  std::vector<double*> rows_;
  std::vector<double> mass_;
};

/// F = stiffness * overlap along delta, no torque.  Counts in the history for how many steps a contact lasts.
class Spring final : public contact::ContactModel {
 public:
  explicit Spring(double stiffness) : stiffness_(stiffness) {}
  void evaluate(contact::Contact* contacts, int count) override {
    ++batches;
    for (contact::Contact* c = contacts; c < contacts + count; ++c) {
      c->force = stiffness_ * std::max(c->overlap, 0.0) / c->distance * c->delta;
      c->torque.setZero();
      if (c->history) c->history[0] += 1.0;
      seen.push_back(*c);
    }
  }
  int batches = 0;
  std::vector<contact::Contact> seen;  ///< in all steps, until it is cleared

 private:
  double stiffness_;
};

/// Balls, a wall and a spring between them, in one process.
class BallsOnWall {
 public:
  BallsOnWall(coupling::StructureSolver& structure, Balls balls, double stiffness, double dt,
              const contact::PeriodicBox& box = {{-9, -9, -9}, {9, 9, 9}, {false, false, false}})
      : balls(std::move(balls)),
        spring(stiffness),
        structure_(structure),
        exchange_(MPI_COMM_SELF, structure),
        loop(structure, exchange_, {}),
        dt_(dt),
        box_(box) {
    structure_.set_time_step(dt);
    structure_.begin_run();
    loop.wall().import();
    loop.wall().weld_across(contact::periods(box));
    build_list();
    evaluate(true);
  }

  void build_list() { loop.build_list(balls.view(), {kSkin, 1.0, dt_, box_}); }
  /// Forces of the wall where everything now is.
  void evaluate(bool is_setup = false) {
    std::fill(balls.f.begin(), balls.f.end(), 0.0);
    std::fill(balls.torque.begin(), balls.torque.end(), 0.0);
    if (loop.has_outgrown_list(balls.view())) build_list();
    spring.seen.clear();
    loop.step(balls.view(), {step_, dt_, 1.0, is_setup}, spring);
  }
  /// One step of velocity Verlet.  `lists`: the balls' own are due.
  void step(bool lists = false) {
    ++step_;
    for (size_t k = 0; k < balls.x.size(); ++k) balls.x[k] += dt_ * (balls.v[k] += 0.5 * dt_ * balls.f[k]);
    exchange_.begin_step();
    loop.wall().import();
    if (loop.wall_motion() > 0.5 * kSkin || lists) build_list();
    evaluate();
    forces = &exchange_.export_add(loop.forces_on_body());
    structure_.end_step(*forces);
    for (size_t k = 0; k < balls.v.size(); ++k) balls.v[k] += 0.5 * dt_ * balls.f[k];
  }

  static constexpr double kSkin = 0.2;
  const coupling::SurfaceExchange& exchange() const { return exchange_; }

  Balls balls;
  Spring spring;
  const coupling::NodalForces* forces = nullptr;  ///< on the structure, of the last step

 private:
  coupling::StructureSolver& structure_;
  coupling::SurfaceExchange exchange_;

 public:
  contact::ContactLoop loop;

 private:
  double dt_;
  contact::PeriodicBox box_;
  long step_ = 0;
};

/// Until the first ball, of mass 1, has left again: m x'' = -k x for half a period.
inline void expect_half_an_oscillation(BallsOnWall& scene, double stiffness, double speed, double dt) {
  double deepest = 0.0;
  int steps = 0;
  do {
    scene.step();
    ++steps;
    ASSERT_LE(scene.loop.contacts().size(), 1u);
    if (!scene.loop.contacts().empty()) deepest = std::max(deepest, scene.loop.contacts()[0].overlap);
  } while (scene.balls.velocity(0)[2] < 0.0 || !scene.loop.contacts().empty());
  const double omega = std::sqrt(stiffness);
  EXPECT_NEAR(steps * dt, M_PI / omega, 2.0 * dt);
  EXPECT_NEAR(deepest, speed / omega, 1e-6);
  EXPECT_NEAR(scene.balls.velocity(0)[2], speed, 1e-4);
}

}  // namespace test
