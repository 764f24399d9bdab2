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

#include <algorithm>
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

// Elastic, perfectly plastic spheres without adhesion: C. Thornton, J. Appl. Mech. 64 (1997) 383-386;
// C. Thornton, Z. Ning, Powder Technology 99 (1998) 154-162.  The pressure in the contact is Hertz' until it
// reaches the yield pressure p_y in the middle, at the overlap d_y, and is cut off there from then on:
//
//   d <= d_y     F = 4/3 E* sqrt(r*) d^(3/2)            d_y = r* (pi p_y/(2 E*))^2
//   loading      F = F_y + pi p_y r* (d - d_y)          as steep as Hertz' law at d_y
//   below d_max  F = 4/3 E* sqrt(r_p) (d - d_p)^(3/2)   Hertz on the flattened surface, of radius r_p > r*
//
// with the largest overlap d_max of this contact the only memory: there F is F_max and the contact radius
// a_max = sqrt(r* d_max), also that of Hertz on r_p, so r_p = 4 E* a_max^3/(3 F_max) and
// d_p = d_max - a_max^2/r_p, the depth that is left.  Between d_p and the end of the overlap the bodies are
// apart, and the force is 0.  LIGGGHTS' own `thornton_ning`, with adhesion, sums up increments of the force.
struct ThorntonLaw {
  static constexpr const char* word = "plastic/thornton";
  static constexpr int id = 43;
  static constexpr double exponent = HertzLaw::exponent;
  static constexpr double damping_factor = HertzLaw::damping_factor;
  // of two materials the softer yields
  static constexpr std::array<LawProperty, 1> properties = {{{"yieldPressure", LawProperty::Per::type, 0.0}}};
  static constexpr std::array<const char*, 1> history = {"largest_overlap"};

  static LawForce evaluate(const LawContact& c, const double* old, double* next) {
    const double d_max = std::max(old[0], c.d);
    next[0] = d_max;
    const double S_y = kPi * c.property[0] * c.r;  // dF/dd while it yields
    const double root_y = kPi * c.property[0] / (2. * c.E), d_y = c.r * root_y * root_y;
    if (d_max <= d_y) return hertz(c.E, std::sqrt(c.r * c.d), 1.0);

    const double a_max = std::sqrt(c.r * d_max), F_max = S_y * (d_max - d_y / 3.);
    if (c.d == d_max) return {F_max / d_max, S_y, a_max};
    const double rebound = 3. * F_max / (4. * c.E * a_max);  // d_max - d_p
    const double left = std::max(d_max - rebound, 0.0), elastic = std::max(c.d - left, 0.0);
    return hertz(c.E, a_max * std::sqrt(elastic / rebound), elastic > 0.0 ? elastic / c.d : 0.0);
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;

  /// On a contact radius a; the overlap is `elastic_part` of the whole.
  static LawForce hertz(double E, double a, double elastic_part) {
    return {4. / 3. * E * a * elastic_part, 2. * E * a, a};
  }
};

/// All laws.
using ContactLaws = std::tuple<LinearLaw, HertzLaw, QuadraticLaw, ThorntonLaw>;

/// Calls visit(law) for each of them.
template <class Visit>
void for_each_law(Visit visit) {
  std::apply([&](auto... law) { (visit(law), ...); }, ContactLaws{});
}

}  // namespace liggghts_pkg
