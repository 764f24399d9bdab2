// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes in single precision, for trees that look at several at once: in units of the size of all of them,
// from their centre, rounded outwards.  A box that is given up is too far for certain.
#pragma once

#include <cmath>

#include "nurbs/types.h"

namespace nurbs {

class BoxUnits {
 public:
  /// For coordinates between these.
  void set(const Vector3& low, const Vector3& high) {
    size_ = (high - low).norm();
    centre_ = 0.5 * (low + high);
    int exponent;
    std::frexp(size_, &exponent);
    scale_ = size_ > 0.0 ? std::ldexp(1.0, -exponent) : 1.0;
  }
  /// Length of the diagonal of the box around everything.
  double size() const { return size_; }

  // Coordinates are below 1/2 here: rounding moves them by half of this at most.
  float low(double x, int i) const { return static_cast<float>((x - centre_[i]) * scale_ - kHalfUlp); }
  float high(double x, int i) const { return static_cast<float>((x - centre_[i]) * scale_ + kHalfUlp); }

  struct Point {
    float d[3];
    double far;  // from the centre
  };
  Point point(const Vector3& d) const {
    const Vector3 x = scale_ * (d - centre_);
    return {{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])}, x.norm()};
  }
  /// What the square of a distance from the point [length], computed from these boxes, is not above.
  /// Rounding moves the point by half an ulp of its coordinates, and distances by some half ulps of theirs.
  float limit(const Point& point, double distance) const {
    const double moved = (scale_ * distance + 2.0 * kHalfUlp * point.far) * (1.0 + 8.0 * kHalfUlp);
    return static_cast<float>(moved * moved);
  }

 private:
  static constexpr double kHalfUlp = 0x1p-24;  // of single precision, relative

  Vector3 centre_ = Vector3::Zero();
  double size_ = 0.0, scale_ = 1.0;  // 1 / length, a power of two
};

}  // namespace nurbs
