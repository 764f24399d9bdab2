// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes in single precision, for trees that look at several at once: in units of the size of all of them,
// from their centre, rounded outwards.  A box that is given up is too far for certain.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "search/names.h"

namespace search {

/// From lengths to units; coordinates of boxes are below 1/2 there.
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
  Vector3 in_units(const Vector3& x) const { return scale_ * (x - centre_); }

  double in_units(double length) const { return scale_ * length; }

  struct Point {
    float d[3];
    double far;  // from the centre
  };
  Point point(const Vector3& d) const {
    const Vector3 x = in_units(d);
    return {{static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])}, x.norm()};
  }
  /// What the square of a distance from the point [length] is not above as BoxLanes computes it.  Rounding
  /// moves the point, and its distances from the middles of boxes, by half an ulp of their coordinates, and
  /// distances by some half ulps of theirs.
  float limit(const Point& point, double distance) const {
    const double moved = (scale_ * distance + 3.0 * kHalfUlp * point.far) * (1.0 + 8.0 * kHalfUlp);
    return static_cast<float>(moved * moved);
  }
  /// What it is below even where the distance is exactly this.
  float limit_with(const Point& point, double distance) const {
    return std::nextafter(limit(point, distance), std::numeric_limits<float>::infinity());
  }

  static constexpr double kHalfUlp = 0x1p-24;  ///< of single precision, relative

 private:
  Vector3 centre_ = Vector3::Zero();
  double size_ = 0.0, scale_ = 1.0;  // 1 / length, a power of two
};

/// N boxes, one in each lane.
template <int N>
class BoxLanes {
 public:
  using Lanes = Eigen::Array<float, N, 1>;

  /// Infinitely far, until they are set.
  BoxLanes() {
    for (int i = 0; i < 3; ++i) {
      middle_[i].setConstant(std::numeric_limits<float>::infinity());
      half_[i].setZero();
    }
  }
  /// Between these points, in units.
  void set(int lane, const Vector3& low, const Vector3& high) {
    for (int i = 0; i < 3; ++i) {
      const float middle = static_cast<float>(0.5 * (low[i] + high[i]));
      // More than this half may be by its own rounding and by that of a distance from the middle.
      const double half = std::max(high[i] - middle, middle - low[i]) + 2.0 * BoxUnits::kHalfUlp;
      middle_[i][lane] = middle;
      half_[i][lane] = static_cast<float>(half);
    }
  }
  Vector3 middle(int lane) const { return {middle_[0][lane], middle_[1][lane], middle_[2][lane]}; }
  Vector3 half(int lane) const { return {half_[0][lane], half_[1][lane], half_[2][lane]}; }

  /// Squared distances of a point from the boxes.
  Lanes near2(const BoxUnits::Point& point) const {
    Lanes sum = Lanes::Zero();
    for (int i = 0; i < 3; ++i) sum += ((middle_[i] - point.d[i]).abs() - half_[i]).max(0.0f).square();
    return sum;
  }
  /// Adds those from their middles.
  Lanes add_middle2(const BoxUnits::Point& point, const Lanes& near2) const {
    Lanes sum = near2;
    for (int i = 0; i < 3; ++i) sum += (middle_[i] - point.d[i]).square();
    return sum;
  }

 private:
  Lanes middle_[3], half_[3];  // of one coordinate
};

}  // namespace search
