// SPDX-License-Identifier: GPL-2.0-or-later
// Supports that move, in the scheme of the time step: displacements u(n) = u(t(n)) are given, so
//   v(n+1/2) = (u(n+1) - u(n)) / dt,  v(n) = (v(n-1/2) + v(n+1/2)) / 2,  a(n) = 2 (v(n+1/2) - v(n)) / dt,
// and the support does the work of the force that this takes, its inertia + f_int - f_ext - F.
#pragma once

#include <vector>

#include "structure/conditions/supports.h"
#include "structure/time/mass.h"
#include "structure/time/verlet_update.h"

namespace structure {

class SupportMotion {
 public:
  explicit SupportMotion(const Supports& supports);
  /// Of all parts alike: a part that nothing moves asks for the factors, too, which may throw.
  bool is_empty() const { return times_.empty(); }

  /// u(t), and x = reference + u.
  void place(double t, const NodalVectors& reference, NodalVectors& u, NodalVectors& x);
  /// With u those of now, and a step dt to come, to t_next: v(n-1/2), or v(n) if that is what v holds,
  /// becomes v(n).
  void find_velocities(double t_next, double dt, bool holds_half, const NodalVectors& u, NodalVectors& v);
  /// Sets accelerations a of all columns.
  void set_accelerations(NodalVectors& a) const;
  /// Accelerations a of the columns [first, first + count), and what they do to the sums over these.
  void add_accelerations(Eigen::Index first, Eigen::Index count, const NodalForces& f,
                         const MassOperator& mass, NodalVectors& a, ForceSums& sums) const;
  /// v(n) once more, where others have kicked them.
  void set_velocities(NodalVectors& v) const;

 private:
  struct Dof {
    Eigen::Index dof;  // 3 A + direction
    std::size_t motion;
    double size;
    double velocity = 0.0, acceleration = 0.0;
  };
  /// Of the motions at the time t.
  void find_factors(double t);

  std::vector<Dof> moved_;  // rising
  std::vector<TimeFunction> times_;
  std::vector<double> factors_;
};

}  // namespace structure
