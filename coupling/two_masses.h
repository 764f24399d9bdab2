// SPDX-License-Identifier: GPL-2.0-or-later
// How far sub-steps may go: the exact growth of the smallest coupled problem.  A mode of the body (mass M,
// frequency omega) and a particle (mass m) with a linear contact spring k between them: forces that act at
// outer steps of length H alone are impulses, which resonate with what happens in between wherever that
// turns by k pi in H (Ma, Izaguirre & Skeel 2003, SIAM J. Sci. Comput. 24, 1951).
#pragma once

#include <Eigen/Core>

namespace coupling {

/// Frequencies [1/time] and masses of the two.
struct TwoMasses {
  double mode;        ///< omega, of the body's mode without contact
  double contact;     ///< sqrt(k/m), of the particle on a body at rest
  double mass_ratio;  ///< m/M
};

/// The linear map of one outer step on (u, v of the mode, x, v of the particle): r-RESPA (Tuckerman, Berne &
/// Martyna 1992), half kicks by the body's internal forces about `count` particle steps dt.
Eigen::Matrix4d particle_substeps_matrix(const TwoMasses& problem, double dt, int count);
/// The same of one particle step dt of `count` steps of the body: contact acts at its ends, internal forces
/// are those of the displacements `lead` [time] later; `spread`: impulses are (spread_impulse.h).  Velocities
/// are those of the half step before.
Eigen::Matrix4d structure_substeps_matrix(const TwoMasses& problem, double dt, int count, double lead,
                                          bool spread = false);

/// Largest |eigenvalue| less 1: what amplitudes grow by in a step, at worst.
double growth(const Eigen::Matrix4d& step);

/// Growth beyond it is refused, per step; eigenvalues that coincide are off by about a hundredth of it.
constexpr double kMostGrowth = 1e-6;

/// The largest growth of all modes up to `highest.mode` and all contacts up to `highest.contact`.
double most_growth_of_particle_substeps(const TwoMasses& highest, double dt, int count);
double most_growth_of_structure_substeps(const TwoMasses& highest, double dt, int count, double lead,
                                         bool spread = false);

/// The largest number of particle steps dt in a step of the body, up to `most`, up to which no number lets
/// anything grow beyond kMostGrowth, and before the first resonance.
int most_particle_substeps(const TwoMasses& highest, double dt, int most);

}  // namespace coupling
