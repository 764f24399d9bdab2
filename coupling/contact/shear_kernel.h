// SPDX-License-Identifier: GPL-2.0-or-later
// Along the surface a mesh gives way beyond what the law knows, too: Mindlin's spring holds the give of both
// half-spaces.  With its stretch xi, its stiffness k and the matrix c along the surface, the particle has
// slid over the body beyond the dent by what it slides over the foot, u, and what the dent has moved:
//
//   d(xi) = du + d(w),   w = c k xi,
//
// as long as it sticks; so over a step, in which w was kept,  (1 - c k) d(xi) = du + c k xi - w.  Where it
// slips the law cuts xi, and w follows.  The potential of the spring behind c, 1/2 k xi^2 - 1/2 (k xi) . c
// (k xi), changes with the foot: its force along the surface is -1/2 (k xi) . grad c (k xi).
//
// A damper beside the spring must not see what the foot does at once: nodes there are light, and the dent
// that it makes is answered by the whole body later (approach_kernel.h).  So it sees the particle's own speed
// less that of the body beyond the dent, which follows what the spring sees within the time
//
//   c gamma/(1 - c k) + kSlow (m/k)^(1/2).
//
// Many contacts at a time, as approach_kernel.h has them.
#pragma once

#include "nurbs/simd_level.h"

namespace contact {

/// Springs along the surface, number by number.  Vectors are in space; c is that along the unit vectors t of
/// the surface: t_1 along its first direction, t_2 = n x t_1.
struct ShearBlock {
  static constexpr int kCapacity = 16;
  /// Numbers that a contact keeps: w, and the body's velocity in space, all of it: so it does not depend on
  /// who looks, and how the normal turns.
  static constexpr int kMemory = 6;
  using Lanes = double[kCapacity];

  alignas(64) Lanes normal[3] = {};  // unit vector, out of the surface
  Lanes first[3] = {};               // along the surface's first direction [length]
  Lanes give[3] = {};                // c: 11, 22, 12 [length/force]
  Lanes gradient[3][2] = {};         // of each, with the centre's place along S_j [1/force]
  Lanes stiffness = {};              // k [force/length]
  Lanes slip[3] = {};     // rate of slip over the foot; what is along n does not count [length/time]
  Lanes wall[3] = {};     // velocity of the foot: along the surface own speed is both
  Lanes stretch[3] = {};  // xi [length]
  Lanes normal_stiffness = {}, normal_dashpot = {};  // [force/length], [force time/length]
  Lanes inertia = {};                                // of the particle along the surface [mass]
  Lanes memory[kMemory] = {};                        // before and after

  Lanes share = {};         // the largest of c k, which has to be below 1 [-]
  Lanes dashpot = {};       // [force time/length]
  Lanes more_rate[3] = {};  // what the law's damper is to see beyond the slip [length/time]
  Lanes more[3] = {};       // and its spring beyond that of the velocities [length]
  Lanes along[2] = {};      // the force on the particle that belongs to the change of c, in units of S_j
                            // [force/length]

  // On the way:
  Lanes t[2][3] = {};
  Lanes stuck[2] = {};                     // the stretch while it sticks
  Lanes body[2] = {}, body_slips[2] = {};  // the body's speed beyond the dent, and if it slips
};

/// All lanes, whether they are in use or not.
struct ShearKernel {
  /// What the law is to see of a step of dt.
  void (*begin)(ShearBlock& block, double dt);
  /// With the stretch after it: memory and force.
  void (*end)(ShearBlock& block);
};

/// Throws std::invalid_argument if this machine does not have the instruction set.
ShearKernel shear_kernel(nurbs::SimdLevel level);

}  // namespace contact
