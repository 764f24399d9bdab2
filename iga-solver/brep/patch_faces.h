// SPDX-License-Identifier: GPL-2.0-or-later
// The faces of a wall that are NURBS patches, each with its search.
#pragma once

#include <memory>
#include <vector>

#include "brep/names.h"
#include "nurbs/curvature.h"
#include "search/surface_projector.h"

namespace brep {

class PatchFaces {
 public:
  /// Throws std::invalid_argument as nurbs::check_patch does.
  explicit PatchFaces(std::vector<nurbs::Surface> patches);
  PatchFaces(const PatchFaces&) = delete;  // searches refer to patches

  int count() const { return static_cast<int>(patches_.size()); }
  const nurbs::Surface& patch(int p) const { return patches_[p]; }
  const search::SurfaceProjector& projector(int p) const { return *projectors_[p]; }

  const search::Box& box(int p, int element) const { return boxes_[p][element]; }
  Vector3 point(int p, const Parameter<2>& xi) const;
  /// Point, normal along dS/dxi0 x dS/dxi1, curvatures; at a pole those of a point beside it.
  nurbs::SurfaceShape shape(int p, const Parameter<2>& xi) const;
  /// d S / d xi_i [length / parameter]
  Vector3 tangent(int p, const Parameter<2>& xi, int i) const;
  /// Whether xi is at an end of a range of the patch's parameters.
  bool on_border(int p, const Parameter<2>& xi) const;

 private:
  std::vector<nurbs::Surface> patches_;
  std::vector<std::unique_ptr<search::SurfaceProjector>> projectors_;
  std::vector<std::vector<search::Box>> boxes_;  // of elements
};

}  // namespace brep
