// SPDX-License-Identifier: GPL-2.0-or-later
// How far a contact's force is spread about its foot, and its law then.  Near s = 1 (compliance.h) a point
// force has no equilibrium on the mesh, which is finer than the contact's disc; one that is spread as the
// contact is has.  So the force is R + w Z (coupling/net_spread.h), where from s = 0.5 to 0.7 of a point
// force
//
//   w = theta(s) W(a^2/(3 m)),   W(y) = y/(1 + y^4)^(1/4),   a^2 = r* x,
//
// grows until Z, of second moment m, has w m = a^2/3, that of the pressure of a flat punch on Hertz' disc, as
// far as one mean over the net goes: the surface below it is flat, as a foot wants it (Hertz' own pressure,
// a^2/5, leaves it as round as the ball).  What it meets the surface by is its own mean: the displacement
// that is met is less by w q, q being how far the surface is above the foot under Z, and c(w) = c + 2 w b +
// w^2 d (coupling/local_compliance.h).  w moves with the force, and so does its potential
//
//   U = stationary over F of  F (overlap + w q) + c(w) F^2/2 - integral of x dF,
//
// which asks for  x - c(w) F - F dw/dF mu = overlap + w q,  mu = q + F (b + w d) = dU/dw / F.  At rest
// mu = 0: c(w) is what mesh and half-space differ by, whatever w is.
#pragma once

namespace contact {

struct SpreadWeight {
  static constexpr double kBegin = 0.5, kEnd = 0.7;  ///< of s under a point force

  double w = 0.0;
  double by_c = 0.0, by_moment = 0.0;       ///< its changes [force/length], [1/length^2]
  double by_log = 0.0, by_log_twice = 0.0;  ///< first and second derivatives with log x
};

/// A contact with a law after Hertz, F = K x^(3/2), whose force may be spread.
struct SpreadLaw {
  double K, radius;     ///< [force/length^(3/2)], [length]
  double c, one, both;  ///< c, b and d [length/force]
  double moment;        ///< m [length^2]
  double above;         ///< q [length]

  SpreadWeight weight(double x) const;
  double give(double w) const { return c + w * (2.0 * one + w * both); }

  struct State {
    double x, force, overlap;
    double s;         ///< 1 - d(overlap)/dx
    double mismatch;  ///< mu [length]
    SpreadWeight weight;
  };
  State at(double x) const;
  /// Where the overlap is this, near x = `from`; with s at `limit` or more if there is none below it, and
  /// with s = 0 where a point force has less than kBegin.
  State solve(double overlap, double from, double limit) const;
};

}  // namespace contact
