// SPDX-License-Identifier: GPL-2.0-or-later
// How particles and a body whose mesh gives way under them come together, many contacts at a time, as
// functions on plain numbers: they are compiled once for each instruction set that simd_level.h knows, and
// all find the same digits, as nothing is fused.
//
// The law's own overlap x is what is left of the geometric one when the mesh's part is taken off,
//
//   x - c F = overlap,   F = K x^(3/2).
//
// With damping, F = K x^(3/2) + D x^(1/4) dx/dt, both cannot be solved for F in a step: that is a negative
// spring -c behind a dashpot, and F runs away within c gamma, gamma = D x^(1/4), while the mesh takes its
// time to give way; the earlier the damping, the more so: in the beginning of a contact the dent is deeper
// than x, and the surfaces lose touch.  So x is followed in time instead, as the particle's own motion and u,
// the body's beyond the dent, have it, and w, how that changes; all three are held to what overlap and force
// show, by an observer (D. G. Luenberger, IEEE Trans. Military Electron. 8, 1964) with a triple pole:
//
//   dx/dt = v + u + 3 omega e,   du/dt = w + 3 omega^2 e,   dw/dt = omega^3 e,   e = overlap + c F - x,
//   1/omega = 2 c gamma/(1 - s) + h/c_s + kSlow (m/S)^(1/2),   S = d(K x^(3/2))/dx,  s = c S.
//
// Faster than half the first term it would answer its own force before the dent does, which takes the second;
// the third is a fraction of how long contacts last.  A body that stands beyond the dent, or is pushed away
// evenly, is known exactly, whatever the dent does.
//
// The damper's rate is v + u + omega e.  Where the body vibrates with the frequency f it then has
//   (omega^3 - omega f^2 + 3 i omega^2 f) / (omega + i f)^3
// of the body's speed, whose real part is never negative: whatever the frequency, the damper takes energy.
// Without omega e it would feed all that is faster than 1.6 omega, as long as the contact lasts.
//
// Of a body that is as light as the particle, or lighter where it is hit, the observer knows too late that it
// is gone, and the damper would go on to push what goes away.  So the contact keeps an account of F
// d(overlap), and gives no more than it has taken: no energy comes of it, whatever the body does.  A dent
// holds energy that comes back; strong damping makes it deeper than the bodies have come together.  A heavy
// body lets a contact have that as a credit.
#pragma once

#include "nurbs/simd_level.h"

namespace contact {

/// Contacts with a law after Hertz, number by number.
struct ApproachBlock {
  static constexpr int kCapacity = 16;
  /// Numbers that a damped contact keeps, all 0 in a new one: x, w; the energy that it has taken, its force,
  /// its overlap; u.
  enum { kX, kW, kTaken, kForce, kOverlap, kU, kMemory };
  using Lanes = double[kCapacity];

  alignas(64) Lanes overlap = {};  // geometric [length]
  Lanes of_particle = {};          // its speed along the normal, into the body [length/time]
  Lanes of_surface = {};           // the foot's, out of the body
  Lanes radius = {};               // effective [length]
  Lanes constant = {};             // K / radius^(1/2) [pressure]
  Lanes give = {};                 // c, what the mesh gives way more than the law knows of [length/force]
  // Of those with damping, else 0 or not looked at:
  Lanes damping = {};          // D / radius^(1/4) [force time/length^(3/2)]
  Lanes inertia = {};          // of the particle; infinite: as heavy as can be [mass]
  Lanes delay = {};            // h/c_s, until the mesh gives way [time]
  Lanes credit = {};           // what it may give more than it has taken, if it is new [energy]
  Lanes memory[kMemory] = {};  // before and after the step; where x is negative it is over, although the
                               // surfaces may not have come apart yet

  // What the law is to be asked with, and what it answers:
  Lanes x = {}, root = {};     // x, which is positive while a damped contact is on; x^(1/2)
  Lanes rate = {};             // of x [length/time]
  Lanes force = {};            // [force]
  Lanes give_way = {};         // the share of x that c gives way, s = c dF/dx; in excess of a limit that is
                               // asked for: no solution is known [-]
  Lanes stiffness = {};        // S [force/length]
  Lanes tangent = {};          // dF/d(overlap), with the damper's part of a step [force/length]
  Lanes dashpot = {};          // gamma [force time/length]
  Lanes K = {}, quarter = {};  // [force/length^(3/2)]; x^(1/4) of a damped contact

  // On the way: of x + ... = left behind give/share, force = K x^(3/2) + of_damper + damper x
  Lanes of_damper = {}, damper = {}, share = {}, left = {}, turn = {};
  Lanes e = {}, q = {}, moves = {}, asked = {};
};

struct ApproachStep {
  double limit;   ///< the largest share that may give way, below 1
  double dt;      ///< [time]
  double passed;  ///< since contacts were here last: dt, or 0 where nothing has moved [time]
};

/// All lanes, whether they are in use or not.
struct ApproachKernel {
  /// Of an overlap that is positive.
  void (*elastic)(ApproachBlock& block, const ApproachStep& step);
  /// Of any overlap.
  void (*damped)(ApproachBlock& block, const ApproachStep& step);
};

/// Throws std::invalid_argument if this machine does not have the instruction set.
ApproachKernel approach_kernel(nurbs::SimdLevel level);

}  // namespace contact
