// SPDX-License-Identifier: GPL-2.0-or-later
// How a particle and a body whose mesh gives way under it come together, as a law with damping needs it:
//
//   F = K x^(3/2) + D x^(1/4) dx/dt,   x = overlap + c F,
//
// c what the mesh gives way more than the law knows of (compliance.h).  Both cannot be solved for F in a
// step: that is a negative spring -c behind a dashpot, and F runs away within c gamma, gamma = D x^(1/4),
// while the mesh takes its time to give way; the earlier the damping, the more so: in the beginning of a
// contact the dent is deeper than x, and the surfaces lose touch.  So x is followed in time instead, as the
// particle's own motion and u, the body's beyond the dent, have it, and w, how that changes; all three are
// held to what overlap and force show, by an observer (D. G. Luenberger, IEEE Trans. Military Electron. 8,
// 1964) with a triple pole:
//
//   dx/dt = v + u + 3 omega e,   du/dt = w + 3 omega^2 e,   dw/dt = omega^3 e,   e = overlap + c F - x,
//   1/omega = 2 c gamma/(1 - s) + h/c_s + kSlow (m/S)^(1/2),   S = dF/dx,  s = c S.
//
// Faster than half the first term it would answer its own force before the dent does, which takes the second;
// the third is a fraction of how long contacts last.  A body that stands beyond the dent, or is pushed away
// evenly, is known exactly, whatever the dent does.
//
// The damper's rate is v + u + omega e.  Where the body vibrates with the frequency f it then has
//   (omega^3 - omega f^2 + 3 i omega^2 f) / (omega + i f)^3
// of the body's speed, whose real part is never negative: whatever the frequency, the damper takes energy.
// Without omega e it would feed all that is faster than 1.6 omega, as long as the contact lasts.
#pragma once

namespace contact {

struct DampedLaw {
  double K;        ///< [force/length^(3/2)]
  double D;        ///< [force time/length^(5/4)]
  double inertia;  ///< of the particle; infinite: as heavy as can be [mass]
  double give;     ///< c [length/force]
  double delay;    ///< h/c_s, until the mesh gives way [time]
};

class DampedApproach {
 public:
  static constexpr int kMemory = 3;  ///< numbers that a contact keeps; all are 0 in a new one

  /// What a contact keeps.
  explicit DampedApproach(double* memory) : x_(memory[0]), u_(memory[1]), w_(memory[2]) {}

  /// A step on: the speeds of particle and surface towards each other along the normal [length/time].  Where
  /// the step is a setup, in which nothing moves, dt is 0.
  void advance(double overlap, double of_particle, double of_surface, double dt);
  /// Whether it presses, or pulls; else it is over, although the surfaces may not have come apart yet.
  bool is_on() const { return x_ > 0.0; }
  double x() const { return x_; }
  double root() const { return root_ * root_; }  ///< x^(1/2), where it is on
  double rate() const { return rate_; }
  double dashpot(const DampedLaw& law) const { return law.D * root_; }  ///< gamma [force time/length]
  /// The damper's force, which depends on what its force leaves of the overlap: force + stiffness x.
  struct Damper {
    double force, stiffness;  ///< [force], [force/length]
  };
  Damper damper(const DampedLaw& law, double dt);
  /// After that, with the overlap that its force F leaves, x = overlap + c F.
  void observe(double x, double dt);
  void keep(double* memory) const { memory[0] = x_, memory[1] = u_, memory[2] = w_; }

  /// By how much the surfaces may lose touch while the contact goes on [length].
  static double held_gap(const double* memory) { return memory[0] > 0.0 ? kDent * memory[0] : 0.0; }

 private:
  static constexpr double kOver = -1.0, kDent = 10.0, kSlow = 0.15;
  double x_, u_, w_;  // x = 0: new; kOver: w is the least overlap since
  double rate_ = 0.0;
  double root_ = 0.0;  // x^(1/4) as it presses
  double turn_ = 0.0;  // omega dt
};

}  // namespace contact
