// SPDX-License-Identifier: GPL-2.0-or-later
// Several patches as one surface: control points in one matrix, elements in one numbering, welded edges.
#pragma once

#include "nurbs/borders.h"

namespace nurbs {

/// A point of a surface that consists of patches.
struct SurfacePoint {
  int patch;
  Parameter<2> xi;
};

/// Topology of a surface of patches.  The control points of all patches are the columns of one matrix
/// (3 x control_point_count()), patch after patch; so are the elements numbered.
class MultiPatch {
 public:
  /// Without patches.
  MultiPatch() : first_control_point_{0}, first_element_{0} {}
  /// Borders as find_borders gives them, or none: all edges free.  Throws std::invalid_argument unless there
  /// is a patch, and four borders for each if any.
  explicit MultiPatch(std::vector<Space<2>> patches, Borders borders = {});

  int patch_count() const { return static_cast<int>(patches_.size()); }
  const Space<2>& patch(int p) const { return patches_[p]; }
  int first_control_point(int p) const { return first_control_point_[p]; }
  int control_point_count() const { return first_control_point_.back(); }
  int first_element(int p) const { return first_element_[p]; }
  int element_count() const { return first_element_.back(); }
  int patch_of_element(int element) const;
  const Border& border(int p, int side) const { return borders_[p][side]; }
  const Borders& borders() const { return borders_; }
  void set_borders(Borders borders);

  /// The control points of one patch out of those of all.
  auto control_points_of(int p, const NodalVectors& all) const {
    return all.middleCols(first_control_point_[p], patches_[p].control_point_count());
  }
  /// Whether a point lies on a side of its patch.
  bool on_side(const SurfacePoint& point, int side) const {
    return point.xi[side / 2] == end_of_side(point.patch, side);
  }
  /// The parameter that is the same all along a side.
  double end_of_side(int patch, int side) const {
    const KnotVector& knots = patches_[patch].knots(side / 2);
    return side % 2 == 1 ? knots.back() : knots.front();
  }
  /// The same point in the parameters of the patch beyond a welded side on which it lies.
  SurfacePoint across(const SurfacePoint& point, int side) const;

 private:
  std::vector<Space<2>> patches_;
  Borders borders_;
  std::vector<int> first_control_point_, first_element_;  // one more than patches
};

/// Patches with coordinates, as readers give them.
struct PatchedSurface {
  MultiPatch topology;
  NodalVectors control_points;  ///< 3 x topology.control_point_count() [length]
};
/// Joins patches whose edges coincide (find_borders with its tolerance).  Throws std::invalid_argument if
/// there are none.
PatchedSurface join(const std::vector<Surface>& patches);
/// The patches of a joined surface, with coordinates.
std::vector<Surface> split(const MultiPatch& topology, const NodalVectors& control_points);

/// The basis at a point; control points in the numbering of the whole surface.
void evaluate(const MultiPatch& surface, const SurfacePoint& at, int derivatives, RationalBasis<2>& out);

}  // namespace nurbs
