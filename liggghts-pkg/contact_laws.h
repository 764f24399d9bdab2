// SPDX-License-Identifier: GPL-2.0-or-later
// Contact laws for the normal force, for walls and for `pair_style gran`.  A law is a struct of this file
// with
//
//   word, id            in the deck, and in LIGGGHTS' hash of a model combination (6 bits; 40 and above are
//                       free)
//   exponent            n of F ~ d^n
//   damping_factor      sqrt((n+1)/(2n))
//   properties          what it takes from the deck's `property/global`
//   history             names of the values that it remembers of a contact; all are 0 in a new one
//   evaluate(contact, old, next)
//                       the force, from the history of the last step; `next` receives that of this step
//
// and its name in ContactLaws at the end.  The rest (words, messages, memory, restart, migration, damping,
// tangential stiffness) is law_normal_model.h for all of them: damping, and what tangential models get, as
// LIGGGHTS' hertz has them,
//
//   F_damp = -gamma_n v_n    gamma_n = 2 zeta sqrt((n+1)/(2n)) sqrt(S_n m*)
//   k_t = S_t = 8 G* a       gamma_t = 2 zeta sqrt(5/6) sqrt(S_t m*)
//
// with zeta = -ln e/sqrt(ln^2 e + pi^2), S_n = dF/dd the law's tangent stiffness and a its contact radius.
#pragma once

#include <array>
#include <cmath>
#include <tuple>

namespace liggghts_pkg {

/// A number > 0 of the deck, `fix ID all property/global NAME peratomtype|peratomtypepair ...`.
struct LawProperty {
  enum class Per { type, pair };

  const char* name;
  Per per;              ///< of two types the smaller value counts
  double length_power;  ///< of its unit, which may have a pressure, too
};

/// A contact, as laws see it.
struct LawContact {
  double r;                ///< r*: r_i on a wall, r_i r_j/(r_i + r_j) between particles [length]
  double d;                ///< overlap, >= 0 [length]
  double E;                ///< E*, as in hertz [pressure]
  const double* property;  ///< values for these two types, in the order of Law::properties
};

struct LawForce {
  double secant;          ///< F/d [force/length]
  double tangent;         ///< dF/dd [force/length]
  double contact_radius;  ///< a [length]
};

// The paper's penalty laws, Gao & Feng (2019), eqs. 31-33:
//
//   penalty/linear      F = 4/3 lambda E* sqrt(r*) d            lambda in length^(1/2)
//   penalty/hertz       F = 4/3 lambda E* sqrt(r*) d^(3/2)      lambda is a number
//   penalty/quadratic   F = 4/3 lambda E* sqrt(r*) d^2          lambda in length^(-1/2)
//
// gamma_n gives the coefficient of restitution e exactly, at any speed: with dtau = d^((n-1)/2) dt and
// s = d^((n+1)/2), m d'' + gamma_n d' + K d^n = 0 becomes a linear oscillator in s(tau) of damping ratio zeta
// (for n = 3/2 Antypov & Elliott 2011, Europhys. Lett. 94, 50004, and LIGGGHTS' sqrt(5/6)).  The tangential
// stiffness does not follow lambda: it is Mindlin's, for all laws.  penalty/hertz with lambda = 1 is hertz to
// the last bit.

/// The laws' lambda.
constexpr LawProperty penalty_factor(double exponent) {
  return {"penaltyFactor", LawProperty::Per::pair, 1.5 - exponent};
}

struct LinearLaw {  // eq. 31
  static constexpr const char* word = "penalty/linear";
  static constexpr int id = 40;
  static constexpr double exponent = 1.0;
  static constexpr double damping_factor = 1.0;
  static constexpr std::array<LawProperty, 1> properties = {penalty_factor(exponent)};
  static constexpr std::array<const char*, 0> history = {};

  static LawForce evaluate(const LawContact& c, const double*, double*) {
    const double lambda = c.property[0], stiffness = 4. / 3. * c.E * std::sqrt(c.r);
    return {lambda * stiffness, lambda * stiffness, std::sqrt(c.r * c.d)};
  }
};

struct HertzLaw {  // eq. 32; written in the order of LIGGGHTS' hertz, for equal bits
  static constexpr const char* word = "penalty/hertz";
  static constexpr int id = 41;
  static constexpr double exponent = 1.5;
  static constexpr double damping_factor = 0.91287092917527685576;  // sqrt(5/6)
  static constexpr std::array<LawProperty, 1> properties = {penalty_factor(exponent)};
  static constexpr std::array<const char*, 0> history = {};

  static LawForce evaluate(const LawContact& c, const double*, double*) {
    const double lambda = c.property[0], a = std::sqrt(c.r * c.d);
    return {lambda * (4. / 3. * c.E * a), lambda * (2. * c.E * a), a};
  }
};

struct QuadraticLaw {  // eq. 33
  static constexpr const char* word = "penalty/quadratic";
  static constexpr int id = 42;
  static constexpr double exponent = 2.0;
  static constexpr double damping_factor = 0.86602540378443864676;  // sqrt(3/4)
  static constexpr std::array<LawProperty, 1> properties = {penalty_factor(exponent)};
  static constexpr std::array<const char*, 0> history = {};

  static LawForce evaluate(const LawContact& c, const double*, double*) {
    const double lambda = c.property[0], root = std::sqrt(c.r);
    return {lambda * (4. / 3. * c.E * root * c.d), lambda * (8. / 3. * c.E * root * c.d),
            std::sqrt(c.r * c.d)};
  }
};

/// All laws.
using ContactLaws = std::tuple<LinearLaw, HertzLaw, QuadraticLaw>;

/// Calls visit(law) for each of them.
template <class Visit>
void for_each_law(Visit visit) {
  std::apply([&](auto... law) { (visit(law), ...); }, ContactLaws{});
}

}  // namespace liggghts_pkg
