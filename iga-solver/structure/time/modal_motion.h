// SPDX-License-Identifier: GPL-2.0-or-later
// A linear body in modal coordinates, u = sum q_k phi_k + sum s_j(t) psi_j (analysis/modal_basis.h), in time.
// Between contacts every mode goes on exactly: its own vibration, damping, loads and motions of supports that
// are linear over the step.  Contact forces, which are known only where the step has led, kick the velocities
// at its ends by dt/2, as velocity Verlet does: the impulse method (Hairer, Lubich & Wanner 2006, sec.
// XIII.1), symmetric and symplectic without damping, of second order in contact, its kicks what the other
// side gets.
//   begin_step  v += dt/2 Q(n), exact motion from t(n) to t(n+1)
//   end_step    v += dt/2 Q(n+1)
// A mode that turns by more than kMostTurn in a step is not in time with forces known once a step, and
// impulses would resonate with it: it is slowed to that, by mass, and gives way as before.
#pragma once

#include <array>
#include <vector>

#include "structure/conditions/time_function.h"
#include "structure/exact_sum.h"
#include "structure/time/oscillator.h"
#include "structure/time/work_ledger.h"

namespace structure {

/// What is known of the body.
struct ModalSystem {
  Eigen::VectorXd eigenvalues;    ///< omega_k^2 [1/time^2], for modes of modal mass 1
  Eigen::VectorXd damping_ratio;  ///< of critical damping, of each mode, for motion about psi
  double mass_damping = 0.0;      ///< rate [1/time]
  /// Of each mode, what the material's viscosity takes: b phi_k . K phi_k without springs to the ground
  /// [1/time].  Of several modes only each one's own: with such springs they are not quite independent.
  Eigen::VectorXd viscosity;
  std::vector<TimeFunction> times;  ///< s_j(t), motions of supports
  Eigen::MatrixXd share;            ///< phi_k . M psi_j, modes x motions
  Eigen::MatrixXd stiffness;        ///< psi_i . K psi_j
  Eigen::MatrixXd viscous;          ///< b psi_i . K psi_j, without springs
  /// psi_i . M psi_j less what the modes have of it; the same of free degrees of freedom alone.
  Eigen::MatrixXd mass, free_mass;
};

/// Generalised forces: on each mode, then on each psi.
using ModalForces = Eigen::VectorXd;

class ModalMotion {
 public:
  static constexpr double kMostTurn = 1.0;  ///< [rad] of a mode in a step

  explicit ModalMotion(ModalSystem system);

  /// dt [time]; throws std::invalid_argument unless it is positive and finite.
  void set_time_step(double dt);
  /// How many modes are slowed with this step.
  int slowed() const { return slowed_; }
  /// q, and velocities phi_k . M du/dt of the modes, at a time.
  void set_state(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& v);
  /// ds/dt [1/time] of the supports' motions now; they are at rest unless told.
  void set_support_rates(const Eigen::VectorXd& rates) { support_rates_ = rates; }

  /// Before the first step and whenever others have changed: work begins here.
  void initialise_forces(const ModalForces& contacts, const ModalForces& loads);
  /// `loads`: at the end of the step.
  void begin_step(const ModalForces& loads);
  void end_step(const ModalForces& contacts);

  double time() const { return time_; }
  double time_step() const { return dt_; }
  Eigen::Index mode_count() const { return q_.size(); }
  Eigen::Index motion_count() const { return s_.size(); }
  /// q and s: what shapes phi, psi are multiplied by.
  Eigen::VectorXd coordinates() const;
  /// The same for velocities; of the last half step, as positions change over it, and now.
  const Eigen::VectorXd& half_step_rates() const { return half_rates_; }
  Eigen::VectorXd rates() const;
  /// d2 s / dt2 [1/time^2].
  Eigen::VectorXd support_accelerations() const;

  double kinetic_energy() const;
  double strain_energy() const;
  Work work() const;

  /// Time, q, v and velocities of supports, to go on from.
  std::vector<double> save() const;
  void load(const double* state);
  static std::size_t state_size(Eigen::Index modes, Eigen::Index motions) { return 1 + 2 * modes + motions; }

 private:
  enum { kLoadWork, kContactWork, kSupportWork, kDampedWork, kWorks };
  Eigen::VectorXd motions_at(double t) const;
  /// Per time, over the step from now on.
  Eigen::VectorXd slopes_ahead() const;
  void kick(const ModalForces& contacts, double h);
  void move_modes(const ModalForces& loads, const Eigen::VectorXd& slopes);
  void move_supports(const ModalForces& loads, const Eigen::VectorXd& slopes);
  void book(int kind, double work) { works_[kind].add(work); }

  ModalSystem system_;
  std::vector<OscillatorStep> steps_;
  Eigen::VectorXd inertia_damping_;  // of each mode, what it loses to motion in space
  int slowed_ = 0;
  double dt_ = 0.0, time_ = 0.0;
  Eigen::VectorXd q_, v_, s_, support_rates_, slopes_, half_rates_;
  ModalForces contacts_, loads_;
  std::array<ExactSum, kWorks> works_;
  double strain_start_ = 0.0;
};

}  // namespace structure
