// SPDX-License-Identifier: GPL-2.0-or-later
// The angle of a direction without branches and without a call, so that many are found at a time: the same
// digits one by one and in a loop of vector instructions.  Internal linkage, as kernels include it that are
// compiled for several instruction sets.
#pragma once

namespace brep {

/// Of (cos, sin), of any length but zero, in [-pi, pi]; as atan2(sin, cos), to 3e-16 of pi [rad].
/// atan(t) = t + t^3 P(t^2) for |t| <= tan(pi / 8), P the polynomial of degree 10 that is best in Chebyshev's
/// sense (error 6e-18); beyond, atan(t) = pi / 4 + atan((t - 1) / (t + 1)).
[[gnu::always_inline]] static inline double angle_of(double cos, double sin) {
  constexpr double kPi = 3.14159265358979323846, kTanOfEighth = 0.41421356237309503;
  constexpr double kP[] = {-0.3333333333333333,  0.1999999999999552,   -0.14285714284666542,
                           0.11111111015256292,  -0.09090904578121085, 0.07692183190760651,
                           -0.0666451144646022,  0.05858148904795124,  -0.050854496960392584,
                           0.039231657085083686, -0.019176885636589053};
  const double x = __builtin_fabs(cos), y = __builtin_fabs(sin);
  const double less = y > x ? x : y, more = y > x ? y : x;
  const bool is_far = less > kTanOfEighth * more;
  const double t = (is_far ? less - more : less) / (is_far ? less + more : more), t2 = t * t;
  double p = kP[10];
  for (int k = 9; k >= 0; --k) p = p * t2 + kP[k];
  double angle = (is_far ? 0.25 * kPi : 0.0) + (t + t * t2 * p);
  angle = y > x ? 0.5 * kPi - angle : angle;
  angle = cos < 0.0 ? kPi - angle : angle;
  return __builtin_copysign(angle, sin);
}

}  // namespace brep
