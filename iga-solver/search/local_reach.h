// SPDX-License-Identifier: GPL-2.0-or-later
// How far from a surface a foot is the nearest point of its neighbourhood, without any look at the point.
//
// In a window (a rectangle of elements without a crease inside) let f be a foot of d at the distance r: phi
// falls from f into no direction of the window.  With homogeneous points X = A - f W (zero at f) and v a
// Cartesian measure of parameters from f on, let |X| >= (1 - e) |v| and |X_vv| <= M.  Then at every point S
//   W^2 (|S - d|^2 - r^2) = |X|^2 - 2 W X.(d - f) >= ((1 - e)^2 - W_max M r) |v|^2,
// so nothing in the window is nearer than f if r < (1 - e)^2 / (W_max M).  Two feet that near cannot be.
// e and M come from the control points of the first and second derivatives, in a frame of the window: e is
// how much the first derivatives change along the plane of the frame, M a bound of the second derivatives.
// Source: the reach of Federer (1959), "Curvature measures", for a piece of a surface; derivatives after
// Piegl & Tiller (1997), section 3.3.
#pragma once

#include <algorithm>
#include <vector>

#include "search/surface_tree.h"

namespace search {

class LocalReach {
 public:
  /// Keeps a reference to `space`.
  explicit LocalReach(const Space<2>& space);

  /// Windows around blocks of 2^level x 2^level elements, for levels below this.
  static constexpr int kLevels = 5;

  /// New coordinates: all that is stored is out of date.
  void forget() { ++version_; }
  /// Of the window around the block of that level that holds an element: what is said above holds for r below
  /// it; 0 if nothing is known.
  double operator()(int level, const int (&e)[2], const NodalVectors& control_points) const {
    Stored& stored = stored_[level][(e[0] >> level) + blocks_[level] * (e[1] >> level)];
    if (stored.version != version_) stored = {version_, rounded_reach(window(level, e), control_points)};
    return stored.reach;
  }
  /// The block and its neighbours, as far as no crease is between; empty if one cuts the block.
  ElementWindow window(int level, const int (&e)[2]) const {
    ElementWindow window;
    const int width = 1 << level;
    for (int i = 0; i < 2; ++i) {
      const Axis& axis = axes_[i];
      const int first = e[i] & -width, count = static_cast<int>(axis.end.size());
      if (axis.end[first] < std::min(first + width, count)) return {{0, 0}, {0, 0}};
      window.begin[i] = std::max(axis.begin[first], first - width);
      window.end[i] = std::min(axis.end[first], first + 2 * width);
    }
    return window;
  }

 private:
  struct Axis {
    std::vector<int> first;       // control point, of each element
    std::vector<int> begin, end;  // elements of the region between creases, of each element
    std::vector<double> first_factor,
        second_factor;  // of differences of control points, by the first of them
  };
  struct Stored {
    unsigned version = 0;
    float reach = 0.0f;  // rounded down
  };
  double reach(const ElementWindow& window, const NodalVectors& control_points) const;
  float rounded_reach(const ElementWindow& window, const NodalVectors& control_points) const;

  const Space<2>& space_;
  Axis axes_[2];
  unsigned version_ = 1;
  int blocks_[kLevels];  // per row
  mutable std::vector<Stored> stored_[kLevels];
};

}  // namespace search
