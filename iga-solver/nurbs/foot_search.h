// SPDX-License-Identifier: GPL-2.0-or-later
// Minimisation of the squared distance from a point to a surface: the machinery behind closest_point.h.
#pragma once

#include "nurbs/closest_point.h"

namespace nurbs {

/// A parameter rectangle inside which S is smooth but for jumps of higher derivatives at knots.
struct SmoothRegion {
  Indices<2> crease;  ///< per direction: the crease (KnotVector::creases) at or before `low`
  Eigen::Vector2d low, high;
};
/// The region between creases that holds u (on a crease, the one right of it).
SmoothRegion region_between_creases(const Space<2>& space, const Eigen::Vector2d& u);
/// One element.
SmoothRegion region_of_element(const Space<2>& space, int element);

/// phi = |S - d|^2 / 2 and its derivatives at u, seen from one smooth region.
struct DistanceSample {
  Eigen::Vector2d u;
  Vector3 S, r;              ///< r = S - d
  double phi;                ///< r.r / 2
  Eigen::Vector2d gradient;  ///< r.S_i
  Eigen::Matrix2d metric;    ///< S_i.S_j, the Hessian of phi for a plane
  Eigen::Matrix2d hessian;   ///< S_i.S_j + r.S_ij
  Eigen::Vector2d speed;     ///< |S_i|
  double scale;              ///< size of the lengths that enter, to which tolerances are relative [length]
};

/// The state of one descent.  The members that return bool say whether they found a way on; when none does,
/// the current point is a local minimum.
class FootSearch {
 public:
  FootSearch(const Space<2>& space, const NodalVectors& control_points, const Vector3& d,
             const Eigen::Vector2d& u, const SmoothRegion& region);

  /// One step downhill inside the region.
  bool descend();
  // Ways on from stationary points that are no minimum:
  bool leave_saddle();
  bool cross_crease();  ///< into the neighbouring region
  bool leave_pole();

  const DistanceSample& at() const { return at_; }
  Projection result(int iterations, bool converged) const;

 private:
  DistanceSample sample(const Eigen::Vector2d& u, const SmoothRegion& region) const;
  Eigen::Vector2d moved(const Eigen::Vector2d& step) const;
  Eigen::Vector2d newton_step() const;
  bool better(const DistanceSample& trial, double expected) const;
  bool negligible(const Eigen::Vector2d& step) const;
  double tangential_distance(const DistanceSample& s) const;
  bool held(const DistanceSample& s, int i) const;
  double phi_round_off() const;

  const Space<2>& space_;
  const NodalVectors& control_points_;
  const Vector3& d_;
  Eigen::Vector2d range_, ulp_;  // of the parameters
  SmoothRegion region_;
  DistanceSample at_;
};

}  // namespace nurbs
