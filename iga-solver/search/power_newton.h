// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's method on one element's power form, written once for one point (double) and for a point in each
// lane (Lanes).  Internal linkage: see power_kernel.cpp, which alone includes this.
#pragma once

#include "search/descent_limits.h"
#include "search/simd_words.h"

namespace search {
namespace {

template <class T>
struct Derivatives {
  T f, f_0, f_1, f_00, f_01, f_11;
};

template <class Number>
struct Jet {
  Number twice_phi, g[2], A[2], H[3];  // as in DistanceJet; A_00 and A_11
};

template <class Surface>
[[gnu::always_inline]] inline Jet<typename Surface::Number> jet(const Surface& surface,
                                                                const typename Surface::Number (&s)[2]) {
  const Derivatives<typename Surface::Vector> S = surface(s[0], s[1]);
  const typename Surface::Vector& r = S.f;
  typename Surface::Number a[4], b[4];
  sums({multiply_add(S.f_0, S.f_0, r * S.f_00), multiply_add(S.f_1, S.f_1, r * S.f_11),
        multiply_add(S.f_0, S.f_1, r * S.f_01), r * S.f_0},
       a);
  sums({r * S.f_1, r * r, S.f_0 * S.f_0, S.f_1 * S.f_1}, b);
  return {b[1], {a[3], b[0]}, {b[2], b[3]}, {a[0], a[2], a[1]}};
}

/// The Newton step -H^-1 g, times det H.
template <class Number>
[[gnu::always_inline]] inline void newton_step(const Number (&H)[3], const Number (&g)[2],
                                               Number (&step)[2]) {
  step[0] = multiply_add(H[1], g[1], -(H[2] * g[0]));
  step[1] = multiply_add(H[1], g[0], -(H[0] * g[1]));
}

/// Newton's method converges quadratically: after such a step one more with the same Hessian is the last.
constexpr double kLastStep = 1e-4;
/// What that step leaves of the error, at most, in local coordinates; it is known from how much shorter it
/// is.
constexpr double kFootError = 1e-14;
/// Steps below this may be round-off, and leave less.
constexpr double kTiny = 1e-12;
/// Nearer to the surface than this part of the element's size the direction of r wants more digits of the
/// foot: the general descent finds them.
constexpr double kClose = 1e-4;

template <class Surface>
struct Foot {
  typename Surface::Number s[2], next[2], distance2;
  typename Surface::Vector r;
  typename Surface::Count iterations;
  typename Surface::Mask done;
};

/// Where Newton's method stops, in all lanes: its last step leads from s, where the Hessian was H.
template <class Surface>
struct Stop {
  typename Surface::Number s[2], step[2], H[3], det, length, twice_phi;
  typename Surface::Count iterations;
  typename Surface::Mask done;
};

/// Once more with the same Hessian: the error shrinks by as much as this step is shorter than the last.
template <class Surface>
[[gnu::always_inline]] inline Foot<Surface> one_more_step(const Surface& surface, const Stop<Surface>& stop) {
  using Number = typename Surface::Number;
  const Number end[2] = {stop.s[0] + stop.step[0], stop.s[1] + stop.step[1]};
  const Derivatives<typename Surface::Vector> S = surface(end[0], end[1]);
  const Number per_det = 1.0 / stop.det, g[2] = {dot(S.f, S.f_0), dot(S.f, S.f_1)};
  Number more[2];
  newton_step(stop.H, g, more);
  for (Number& m : more) m = m * per_det;
  const Number further[2] = {end[0] + more[0], end[1] + more[1]};
  const Number longer = larger(absolute(more[0]), absolute(more[1]));
  const typename Surface::Mask done = stop.done && stop.twice_phi > square(kClose * surface.size()) &&
                                      square(longer) <= kFootError * stop.length + square(kTiny) &&
                                      larger(absolute(further[0]), absolute(further[1])) < kWellInside;
  const typename Surface::Vector r = multiply_add(more[1], S.f_1, multiply_add(more[0], S.f_0, S.f));
  return {{done ? further[0] : stop.s[0], done ? further[1] : stop.s[1]},
          {end[0], end[1]},
          done ? dot(r, r) : stop.twice_phi,
          r,
          stop.iterations,
          done};
}

/// Newton's method from s in all lanes; a lane that needs more than full steps inside its element drops out.
template <class Surface>
[[gnu::always_inline]] inline Foot<Surface> newton(const Surface& surface, typename Surface::Number (&s)[2]) {
  using Number = typename Surface::Number;
  using Mask = typename Surface::Mask;
  constexpr int kMaxIterations = 8;

  Number step[2]{}, to[2] = {s[0], s[1]}, length{}, det{};
  const Number size = surface.size();
  Number twice_phi{}, allowed{};  // where the step began; what Armijo asks for where it ends
  typename Surface::Count iterations{};
  Mask active = larger(absolute(s[0]), absolute(s[1])) < 1.0, done{};
  Jet<Number> f;
  for (int iteration = 1;; ++iteration) {
    f = jet(surface, to);
    if (iteration > 1) {
      const Number excess = 0.5 * f.twice_phi - allowed;
      active = active &&
               (excess <= 0.0 || square(excess) < twice_phi * square(kRoundOff) * (twice_phi + square(size)));
      if (!any(active)) break;
      s[0] = active ? to[0] : s[0];
      s[1] = active ? to[1] : s[1];
    }
    twice_phi = active ? f.twice_phi : twice_phi;
    const Number(&g)[2] = f.g, (&A)[2] = f.A, (&H)[3] = f.H;
    Number steps[2];
    newton_step(H, g, steps);
    det = multiply_add(H[0], H[2], -(H[1] * H[1]));
    for (int i = 0; i < 2; ++i) step[i] = active ? steps[i] / det : step[i];
    to[0] = s[0] + step[0];
    to[1] = s[1] + step[1];
    active = active && H[0] > kLeastCurvature * A[0] && H[2] > kLeastCurvature * A[1] &&
             det > kLeastCurvature * (H[0] * H[2]) && larger(absolute(to[0]), absolute(to[1])) < kWellInside;
    if (!any(active)) break;
    iterations += count(active);

    // det H / (A_00 A_11) is the curvature of phi where a plane has 1.
    length = larger(absolute(step[0]), absolute(step[1]));
    const Mask last = length <= kLastStep && length * (A[0] * A[1]) <= kLastStep * det;
    if (any(last)) {
      const Number pole2 = square(kPole * size);
      done = done || (active && last && A[0] > pole2 && A[1] > pole2);
      active = active && !last;
      if (!any(active)) break;
    }
    if (iteration == kMaxIterations) break;
    to[0] = active ? to[0] : s[0];
    to[1] = active ? to[1] : s[1];
    allowed = multiply_add(kDecrease, multiply_add(g[0], step[0], g[1] * step[1]), 0.5 * f.twice_phi);
  }
  return one_more_step<Surface>(
      surface,
      {{s[0], s[1]}, {step[0], step[1]}, {f.H[0], f.H[1], f.H[2]}, det, length, twice_phi, iterations, done});
}

}  // namespace
}  // namespace search
