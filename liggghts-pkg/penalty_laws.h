// SPDX-License-Identifier: GPL-2.0-or-later
// The paper's penalty laws for the normal contact force, Gao & Feng (2019), eqs. 31-33:
//
//   penalty/linear      F = 4/3 lambda E* sqrt(r*) d            lambda in length^(1/2)
//   penalty/hertz       F = 4/3 lambda E* sqrt(r*) d^(3/2)      lambda is a number
//   penalty/quadratic   F = 4/3 lambda E* sqrt(r*) d^2          lambda in length^(-1/2)
//
// d overlap, r* = r_i on a wall and r_i r_j/(r_i + r_j) between particles, E* as in LIGGGHTS' hertz. Damping,
// and what tangential models get, as hertz has them:
//
//   F_damp = -gamma_n v_n    gamma_n = 2 zeta sqrt((n+1)/(2n)) sqrt(S_n m*)
//   k_t = S_t = 8 G* sqrt(r* d)    gamma_t = 2 zeta sqrt(5/6) sqrt(S_t m*)
//
// with zeta = -ln e/sqrt(ln^2 e + pi^2), n the law's exponent and S_n = dF/dd its tangent stiffness, lambda
// included. This gamma_n gives the coefficient of restitution e exactly, at any speed: with dtau =
// d^((n-1)/2) dt and s = d^((n+1)/2), m d'' + gamma_n d' + K d^n = 0 becomes a linear oscillator in s(tau) of
// damping ratio zeta (for n = 3/2 Antypov & Elliott 2011, Europhys. Lett. 94, 50004, and LIGGGHTS'
// sqrt(5/6)).  The tangential stiffness does not follow lambda: it is Mindlin's, for all laws.  penalty/hertz
// with lambda = 1 is hertz to the last bit.
#pragma once

#include <cmath>
#include <tuple>

namespace liggghts_pkg {

// A law has: its deck word and id (6 bits in LIGGGHTS' hash of a model combination; 40 and above are free),
// its exponent n, sqrt((n+1)/(2n)), and for lambda = 1 the secant stiffness F/d and the tangent stiffness
// dF/dd [force/length].

struct LinearLaw {  // eq. 31
  static constexpr const char* word = "penalty/linear";
  static constexpr int id = 40;
  static constexpr double exponent = 1.0;
  static constexpr double damping_factor = 1.0;
  static double secant_stiffness(double E, double r, double) { return 4. / 3. * E * std::sqrt(r); }
  static double tangent_stiffness(double E, double r, double) { return 4. / 3. * E * std::sqrt(r); }
};

struct HertzLaw {  // eq. 32; written in the order of LIGGGHTS' hertz, for equal bits
  static constexpr const char* word = "penalty/hertz";
  static constexpr int id = 41;
  static constexpr double exponent = 1.5;
  static constexpr double damping_factor = 0.91287092917527685576;  // sqrt(5/6)
  static double secant_stiffness(double E, double r, double d) { return 4. / 3. * E * std::sqrt(r * d); }
  static double tangent_stiffness(double E, double r, double d) { return 2. * E * std::sqrt(r * d); }
};

struct QuadraticLaw {  // eq. 33
  static constexpr const char* word = "penalty/quadratic";
  static constexpr int id = 42;
  static constexpr double exponent = 2.0;
  static constexpr double damping_factor = 0.86602540378443864676;  // sqrt(3/4)
  static double secant_stiffness(double E, double r, double d) { return 4. / 3. * E * std::sqrt(r) * d; }
  static double tangent_stiffness(double E, double r, double d) { return 8. / 3. * E * std::sqrt(r) * d; }
};

/// All laws.  A new one is a struct like those above and its name here.
using PenaltyLaws = std::tuple<LinearLaw, HertzLaw, QuadraticLaw>;

/// Calls visit(law) for each of them.
template <class Visit>
void for_each_law(Visit visit) {
  std::apply([&](auto... law) { (visit(law), ...); }, PenaltyLaws{});
}

}  // namespace liggghts_pkg
