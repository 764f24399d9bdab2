// SPDX-License-Identifier: GPL-2.0-or-later
// The faces of a wall that are NURBS patches, each with its search.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "brep/element_hull.h"
#include "brep/names.h"
#include "nurbs/curvature.h"
#include "search/surface_projector.h"

namespace brep {

class PatchFaces {
 public:
  /// Throws std::invalid_argument as nurbs::check_patch does.
  /// Kinks inside that turn by no more than `edge_angle` are smooth [rad].
  PatchFaces(const std::vector<nurbs::Surface>& patches, double edge_angle);
  PatchFaces(const PatchFaces&) = delete;  // searches refer to patches

  int count() const { return static_cast<int>(patches_.size()); }
  /// The same surface as was given, maybe in more elements.
  const nurbs::Surface& patch(int p) const { return patches_[p]; }
  const search::SurfaceProjector& projector(int p) const { return *projectors_[p]; }

  /// What encloses an element.
  const ElementHull& hull(int p, int element) const { return hulls_[p][element]; }
  Vector3 point(int p, const Parameter<2>& xi) const;
  /// Point, normal along dS/dxi0 x dS/dxi1, curvatures; at a pole those of a point beside it.
  nurbs::SurfaceShape shape(int p, const Parameter<2>& xi) const;
  /// That of shape(), at less cost.
  Vector3 normal(int p, const Parameter<2>& xi) const;
  /// Whether what is within `reach` of d on an element, and around it, has one foot at most, however d moves
  /// as long as it stays within reach (search::SecondFoot).
  bool has_one_foot(int p, int element, const Vector3& d, double reach) const {
    return projectors_[p]->second_foot().excluded_until_next_list(d, reach, element);
  }
  /// Whether an element is nearer than `reach` and its normals and tangents let it have a foot of d, on its
  /// side `side` alone unless that is 0; of d, or of any point less than `margin` away from it that reaches
  /// so much less.
  bool may_have_foot(int p, int element, const Vector3& d, double reach, int side, double margin = 0.0) const;
  /// Local minima of the distance from d nearer than `reach`, given all elements that are and may have one;
  /// in place of those in `feet`.
  void minima_on(int p, const std::vector<int>& elements, const Vector3& d, double reach,
                 std::vector<search::Foot>& feet) const;
  /// Whether elements, each of which has one foot at most, have one at most together: of any point near them.
  bool share_one_foot(int p, const std::vector<int>& elements) const {
    return elements.size() == 1 || (hang_together(p, elements) && is_shallow(p, elements));
  }
  /// d S / d xi_i [length / parameter]
  Vector3 tangent(int p, const Parameter<2>& xi, int i) const;
  /// Whether xi is at an end of a range of the patch's parameters.
  bool on_border(int p, const Parameter<2>& xi) const;

 private:
  // Around directions of length 1.
  struct Cone {
    Vector3 axis;
    double sine;  // of the angle between them and the axis, at most; 2: any
  };
  static Cone cone_around(const std::vector<Vector3>& directions);
  // Around the normals of an element and its tangents.
  struct Cones {
    Cone normal, tangent[2];
    double extent[2];  // of the element along its tangents [length]
  };
  static Cones cones_of(const nurbs::Surface& patch, int element);
  bool follow_downhill(int p, const std::vector<int>& elements, const Vector3& d, double reach,
                       std::vector<search::Foot>& feet) const;
  Parameter<2> below(int p, int element, const Vector3& d) const;
  bool is_lowest_of(int p, const std::vector<int>& elements, const Vector3& d,
                    const search::Foot& border) const;
  bool is_shallow(int p, const std::vector<int>& elements) const;
  bool hang_together(int p, const std::vector<int>& elements) const;

  std::vector<nurbs::Surface> patches_;
  std::vector<std::unique_ptr<search::SurfaceProjector>> projectors_;
  std::vector<std::vector<ElementHull>> hulls_;  // of elements
  std::vector<std::vector<Cones>> cones_;
};

}  // namespace brep
