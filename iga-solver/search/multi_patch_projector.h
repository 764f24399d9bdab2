// SPDX-License-Identifier: GPL-2.0-or-later
// Closest-point projection on a surface of patches: a foot that reaches a welded edge goes on beyond it, and
// a point of such an edge is a local minimum only if it is one for the patches on both sides; a pole, only if
// it is one for all patches around it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "search/names.h"
#include "search/surface_projector.h"

namespace search {

class MultiPatchProjector {
 public:
  /// Keeps references to `surface` and the control points of all patches (3 x n), which must outlive it;
  /// where these are stored may change.  Throws std::invalid_argument unless there is one column for each.
  MultiPatchProjector(const MultiPatch& surface, const NodalVectors& control_points);
  MultiPatchProjector(const MultiPatch& surface, const NodalVectors&& control_points) = delete;

  /// The control points have changed (SurfaceProjector::surface_moved).
  void surface_moved();
  /// A list of candidates is new (SecondFoot::begin_list).  Welds and kinks whose normals are within
  /// `edge_angle` of each other, as the surface now is, are smooth [rad].
  void begin_list(double edge_angle = 0.0);
  /// Whether two feet are on either side of such a weld or kink, as the last list has found it: on
  /// neighbours, or with a crease between.
  bool across_smooth_edge(const Foot& a, const Foot& b) const;
  const MultiPatch& surface() const { return surface_; }
  const NodalVectors& control_points() const { return control_points_; }
  const SurfaceProjector& patch(int p) const { return *patches_[p]; }

  /// Local minimum reached from a point of the surface moved by `image`.
  Foot follow(const Vector3& d, const SurfacePoint& from, const Vector3& image) const;
  /// The same for `count` points, several at a time: feet[k] goes on, on the image where it is, for d[k], to
  /// where follow() leads it, to the last bit.
  void follow(const Vector3* d, Foot* const* feet, int count) const;

  /// Whether no second foot of d can appear, and none vanish or split, on an element within `reach` until the
  /// next list (SecondFoot).
  bool excludes_second_foot(const Vector3& d, double reach, int element) const {
    const int p = surface_.patch_of_element(element);
    return patches_[p]->second_foot().excluded_until_next_list(d, reach, element - surface_.first_element(p));
  }
  /// Adds to `out`, nearest first, the local minima nearer than `reach` on candidate elements (numbers in
  /// rising order) of the surface moved by `image`.  Feet closer than `same_foot` to one in `out` are left
  /// out.
  void add_minima(const Vector3& d, const Vector3& image, double reach, double same_foot, const int* elements,
                  int count, std::vector<Foot>& out) const;

 private:
  double angle_now(int patch, int side) const;
  Foot warm(const Vector3& d, const SurfacePoint& from, const Vector3& image) const;
  Foot cross_borders(const Vector3& d, Foot foot) const;
  bool leads_on(const Vector3& d, const Foot& foot, Foot& beyond) const;
  bool leads_off_pole(const Vector3& d, const Foot& foot, int pole, Foot& beyond) const;

  const MultiPatch& surface_;
  const NodalVectors& control_points_;
  std::vector<std::unique_ptr<SurfaceProjector>> patches_;
  std::vector<std::array<bool, nurbs::kSideCount>> goes_on_;  // beyond the sides of each patch, smoothly
  mutable std::vector<Foot> found_;                           // of one patch
  mutable std::vector<int> patch_elements_;                   // candidates in the patch's own numbering
};

}  // namespace search
