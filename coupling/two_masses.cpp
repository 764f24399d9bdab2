// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/two_masses.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

#include "coupling/spread_impulse.h"
#include "nurbs/types.h"

namespace coupling {

namespace {

/// The state of the two masses for each of four unit states: one column each.
class CoupledMotion {
 public:
  explicit CoupledMotion(const TwoMasses& problem) : problem_(problem) {}

  void kick_by_contact(double h) { kick_by_contact(h, h); }
  void kick_by_contact(double h_mode, double h_particle) {
    const double k_over_m = problem_.contact * problem_.contact;
    const Eigen::RowVector4d gap = x_ - u_;
    v_ += h_mode * k_over_m * problem_.mass_ratio * gap;
    v_particle_ -= h_particle * k_over_m * gap;
  }
  void kick_by_internal_force(double h, double lead = 0.0) {
    v_ -= h * problem_.mode * problem_.mode * (u_ + lead * v_);
  }
  void drift_mode(double dt) { u_ += dt * v_; }
  void drift_particle(double dt) { x_ += dt * v_particle_; }
  Eigen::Matrix4d matrix() const { return (Eigen::Matrix4d() << u_, v_, x_, v_particle_).finished(); }

 private:
  TwoMasses problem_;
  Eigen::RowVector4d u_{1, 0, 0, 0}, v_{0, 1, 0, 0}, x_{0, 0, 1, 0}, v_particle_{0, 0, 0, 1};
};

/// The largest of growth(TwoMasses) on a grid of modes and contacts up to the highest ones.
template <class Growth>
double largest_on_grid(const TwoMasses& highest, int modes, int contacts, Growth growth_of) {
  double largest = 0.0;
  for (int i = 1; i <= modes; ++i)
    for (int j = 1; j <= contacts; ++j)
      largest = std::max(
          largest, growth_of({highest.mode * i / modes, highest.contact * j / contacts, highest.mass_ratio}));
  return largest;
}

}  // namespace

Eigen::Matrix4d particle_substeps_matrix(const TwoMasses& problem, double dt, int count) {
  CoupledMotion motion(problem);
  motion.kick_by_internal_force(0.5 * count * dt);
  for (int i = 0; i < count; ++i) {
    motion.kick_by_contact(0.5 * dt);
    motion.drift_mode(dt);
    motion.drift_particle(dt);
    motion.kick_by_contact(0.5 * dt);
  }
  motion.kick_by_internal_force(0.5 * count * dt);
  return motion.matrix();
}

Eigen::Matrix4d structure_substeps_matrix(const TwoMasses& problem, double dt, int count, double lead,
                                          bool spread) {
  CoupledMotion motion(problem);
  const double inner = dt / count, share = spread ? spread_share(problem.mode, inner, count) : 1.0;
  for (int i = 0; i < count; ++i) {
    motion.kick_by_internal_force(inner, lead);
    if (i == 0) motion.kick_by_contact(share * dt, dt);
    motion.drift_mode(inner);
  }
  motion.drift_particle(dt);
  return motion.matrix();
}

double growth(const Eigen::Matrix4d& step) {
  return Eigen::EigenSolver<Eigen::Matrix4d>(step, false).eigenvalues().cwiseAbs().maxCoeff() - 1.0;
}

double most_growth_of_particle_substeps(const TwoMasses& highest, double dt, int count) {
  return largest_on_grid(highest, 24, 24, [&](const TwoMasses& problem) {
    return growth(particle_substeps_matrix(problem, dt, count));
  });
}

double most_growth_of_structure_substeps(const TwoMasses& highest, double dt, int count, double lead,
                                         bool spread) {
  constexpr double kAngle = 0.02;  // of a mode in a step, from one to the next: damped resonances are wider
  const int modes = static_cast<int>(std::ceil(highest.mode * dt / kAngle));
  return largest_on_grid(highest, std::clamp(modes, 24, 10000), 4, [&](const TwoMasses& problem) {
    return growth(structure_substeps_matrix(problem, dt, count, lead, spread));
  });
}

// Resonances are undamped, and too narrow for a grid: they are where a contact, as a spring between the two
// masses, turns by k pi in an outer step.
int most_particle_substeps(const TwoMasses& highest, double dt, int most) {
  constexpr double kBefore = 0.97 * nurbs::kPi;
  const double contact = highest.contact * std::sqrt(1.0 + highest.mass_ratio),
               turn = 2.0 * std::asin(std::min(1.0, 0.5 * contact * dt));
  most = static_cast<int>(std::min<double>(most, kBefore / turn));
  int count = 1;
  while (count < most && most_growth_of_particle_substeps(highest, dt, count + 1) <= kMostGrowth) ++count;
  return count;
}

}  // namespace coupling
