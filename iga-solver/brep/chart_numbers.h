// SPDX-License-Identifier: GPL-2.0-or-later
// How a direction of a face in closed form lies on that of its patch, as plain numbers and without branches,
// so that many points are placed at a time: the same digits one by one and in a loop of vector instructions.
// Internal linkage, as kernels include it that are compiled for several instruction sets.
#pragma once

namespace brep {

/// Affine, or as many equal arcs, each parametrised as a rational quadratic Bezier arc (Piegl & Tiller 1997,
/// section 7.3).
struct ChartNumbers {
  static constexpr int kMostArcs = 4;

  double low = 0.0, part = 1.0;     ///< on the face: where it begins; 1 / its length
  double first = 0.0, whole = 1.0;  ///< on the patch: where it begins; its length
  double each = 0.0;                ///< of an arc there
  double half_cot = 0.0;            ///< 1/2 cot(a / 4) of their angle a
  /// Of arcs: cosine, sine; those that there are not are the first once more, which is no nearer.
  double middle[kMostArcs][2] = {};
};

/// A parameter of the patch; how far it is from both ends of the range, in arcs or in the whole: less than 0
/// outside of it.
struct OnChart {
  double on_patch, inside;
};

/// Of a length.
[[gnu::always_inline]] static inline OnChart place_length(const ChartNumbers& of, double length) {
  const double s = (length - of.low) * of.part, left = 1.0 - s;
  return {of.first + s * of.whole, left < s ? left : s};
}

/// Of the angle that has this cosine and sine.
[[gnu::always_inline]] static inline OnChart place_angle(const ChartNumbers& of, double cos, double sin) {
  double nearest = cos * of.middle[0][0] + sin * of.middle[0][1],
         across = sin * of.middle[0][0] - cos * of.middle[0][1], arc = 0.0;
  for (int i = 1; i < ChartNumbers::kMostArcs; ++i) {
    const double cos_from_middle = cos * of.middle[i][0] + sin * of.middle[i][1],
                 sin_from_middle = sin * of.middle[i][0] - cos * of.middle[i][1];
    const bool nearer = cos_from_middle > nearest;
    arc = nearer ? static_cast<double>(i) : arc;
    across = nearer ? sin_from_middle : across;
    nearest = nearer ? cos_from_middle : nearest;
  }
  const double t = 0.5 + of.half_cot * across / (1.0 + nearest), left = 1.0 - t;
  return {of.first + (arc + t) * of.each, left < t ? left : t};
}

}  // namespace brep
