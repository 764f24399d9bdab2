// SPDX-License-Identifier: GPL-2.0-or-later
// Whether a point can have a second foot beside one that is known: one question, for two horizons.
//
//   who asks                               until when      how it is answered
//   branch and bound (surface_search.cpp)  now             proved, of a whole window of elements
//   contact (ContactTracker)               the next list   of one element: as proved, where that is enough;
//                                                          else by sampled curvatures, on the side of the
//                                                          point; and no edge, kink or pole is near
//
// Neither answer does for the other.  A proof is of one patch, of both sides of it, and knows nothing where
// an element is bent by much (an exact arc of 90 degrees); samples prove nothing, and what is true of each
// element need not be of all together (a sheet folded onto itself).  Branches are followed from list to list
// all the same there, as each is followed on its own elements.
//
// Now: in a window (a rectangle of elements without a crease inside) let f be a foot of d at the distance r:
// phi falls from f into no direction of the window.  With homogeneous points X = A - f W (zero at f) and v a
// Cartesian measure of parameters from f on, let |X| >= (1 - e) |v| and |X_vv| <= M.  Then at every point S
//   W^2 (|S - d|^2 - r^2) = |X|^2 - 2 W X.(d - f) >= ((1 - e)^2 - W_max M r) |v|^2,
// so nothing in the window is nearer than f if r < (1 - e)^2 / (W_max M).  Two feet that near cannot be.
// e and M come from the control points of the first and second derivatives, in a frame of the window: e is
// how much the first derivatives change along the plane of the frame, M a bound of the second derivatives.
// Source: the reach of Federer (1959), "Curvature measures", for a piece of a surface; derivatives after
// Piegl & Tiller (1997), section 3.3.
//
// Until the next list: along an arc on the surface with curvature kappa towards d, the second derivative of
// half the squared distance is 1 - distance * kappa at a foot.  Where distance * kappa < 1 throughout, and no
// free edge, kink or pole is near, feet move smoothly with d: none appears, none vanishes, none splits.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "search/box.h"
#include "search/patch_points.h"
#include "search/surface_tree.h"

namespace search {

class SecondFoot {
 public:
  /// Of one patch.  Keeps references to both; the control points (3 x n) are looked at when an answer is
  /// worked out.
  SecondFoot(const Space<2>& space, const PatchPoints& control_points);

  /// An angle between tangent planes that counts as none, whatever the caller says [rad].
  static constexpr double kFlush = 1e-6;
  /// Windows around blocks of 2^level x 2^level elements, for levels below this.
  static constexpr int kLevels = 5;

  /// The control points have moved: what was proved is out of date.
  void surface_moved() { ++version_; }
  /// Now: there is none in the window around the block of that level that holds an element, of any point that
  /// has a foot there nearer than this [length]; 0 if nothing is known.
  double excluded_below(int level, const int (&e)[2]) const {
    Stored& stored = stored_[level][(e[0] >> level) + blocks_[level] * (e[1] >> level)];
    if (stored.version != version_) stored = {version_, rounded_reach(window(level, e))};
    return stored.reach;
  }
  /// The block and its neighbours, as far as no crease is between; empty if one cuts the block.
  ElementWindow window(int level, const int (&e)[2]) const;

  /// A list of candidates is new: elements are measured when they are first asked for, where they now are,
  /// and until the next list they may move by less than what reaches allow for (half a skin of the list).
  /// `goes_on`: whether the surface goes on smoothly beyond each side of the patch; `edge_angle`: kinks
  /// inside that turn by no more are smooth [rad].
  void begin_list(const std::array<bool, nurbs::kSideCount>& goes_on, double edge_angle);
  /// Until the next list: there is none, as an element has no free edge, kink or pole within `reach` of d,
  /// and its curvature towards d is less than half of 1 / reach.  (Half, since curvatures are sampled, and
  /// may change.)
  bool excluded_until_next_list(const Vector3& d, double reach, int element) const;

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
  struct Shape {
    unsigned list = 0;           // since which it is known
    bool sampled;                // so are curvatures
    double proved;               // excluded below this when it was measured
    Vector3 centre, normal;      // of the element; normal as dS/dxi x dS/deta
    double least, greatest;      // principal curvatures, positive towards the normal
    int first_kink, kink_count;  // range in kinks_
  };
  double reach(const ElementWindow& window) const;
  float rounded_reach(const ElementWindow& window) const;
  void measure(int element, Shape& shape) const;
  void sample(int element, Shape& shape) const;
  double curvature_towards(const Vector3& d, const Shape& shape) const;
  Box side_box(const Indices<2>& element, int side) const;
  bool smooth_side(const Indices<2>& element, int side) const;

  const Space<2>& space_;
  PatchPoints control_points_;
  Axis axes_[2];
  unsigned version_ = 1;
  int blocks_[kLevels];  // per row
  mutable std::vector<Stored> stored_[kLevels];
  unsigned list_ = 0;
  std::array<bool, nurbs::kSideCount> goes_on_ = {};
  double sine_of_edge_ = kFlush;
  mutable std::vector<Shape> shapes_;  // of each element
  mutable std::vector<Box> kinks_;     // sides of elements beyond which the surface does not go on smoothly
};

}  // namespace search
