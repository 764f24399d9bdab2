// SPDX-License-Identifier: GPL-2.0-or-later
// Where a surface is smooth, and how strongly it bends: what tells whether a particle may gain a second foot.
//
// Along an arc on the surface with curvature kappa towards d, the second derivative of half the squared
// distance is 1 - distance * kappa at a foot.  Where distance * kappa < 1 throughout, and no free edge, kink
// or pole is near, feet move smoothly with d: none appears, none vanishes, none splits.
#pragma once

#include <vector>

#include "search/box.h"
#include "search/names.h"

namespace search {

class Regularity {
 public:
  /// Keeps a reference to `surface`, which must outlive it.
  explicit Regularity(const MultiPatch& surface);

  /// New coordinates (3 x n), kept by reference.  Until the next call they may move by less than what reaches
  /// allow for (half a skin of the list of particles): elements are measured once, valleys where they now
  /// are.
  void set_control_points(const NodalVectors& control_points);

  /// Whether an element has no free edge, kink or pole within `reach` of d, and its curvature towards d is
  /// less than half of 1 / reach.  (Half, since curvatures are sampled, and may change until the next
  /// question.)
  bool is_regular(const Vector3& d, double reach, int element) const;

  /// Whether a foot of d, `distance` away, lies in a valley: the distance does not rise along the surface to
  /// second order, as d is a centre of curvature.  Of a pole counts what is beside it.
  bool in_valley(const Vector3& d, const SurfacePoint& foot, double distance) const;

 private:
  struct Shape {
    bool known = false;
    Vector3 centre, normal;      // of the element; normal as dS/dxi x dS/deta
    double least, greatest;      // principal curvatures, positive towards the normal
    int first_kink, kink_count;  // range in kinks_
  };
  void measure(int element, Shape& shape) const;
  double curvature_towards(const Vector3& d, const Shape& shape) const;
  Box side_box(int patch, const Indices<2>& element, int side) const;
  bool smooth_side(int patch, const Indices<2>& element, int side) const;

  const MultiPatch& surface_;
  const NodalVectors* control_points_ = nullptr;
  mutable std::vector<Shape> shapes_;
  mutable std::vector<Box> kinks_;  // sides of elements beyond which the surface does not go on smoothly
};

}  // namespace search
