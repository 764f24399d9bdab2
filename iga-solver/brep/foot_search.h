// SPDX-License-Identifier: GPL-2.0-or-later
// Which pieces of a wall are near a point, and all its feet on them: the local minima of its distance from
// every sheet (README.md).
#pragma once

#include <vector>

#include "brep/foot.h"
#include "brep/piece_tree.h"
#include "brep/plane_triangles.h"
#include "brep/smooth_neighbours.h"
#include "brep/surface.h"

namespace brep {

class FootSearch {
 public:
  /// Keeps a reference to `surface`, which must outlive it and stay as it is.
  explicit FootSearch(const Surface& surface);
  FootSearch(const Surface&& surface) = delete;

  const Surface& surface() const { return surface_; }

  /// Appends the numbers of the pieces not farther than `reach` [length] from d, rising.
  void near(const Vector3& d, double reach, std::vector<int>& pieces) const;
  /// Those of these pieces that are not farther than `reach`: enough for points within `reach` - `reach of
  /// feet()` of d.  Returns their number; `active` has room for `count`, and may be `pieces`.
  int activate(const Vector3& d, double reach, const int* pieces, int count, int* active) const;
  /// Distance of d from the nearest of these pieces, at least; `reach` if that is less.
  double nearest(const Vector3& d, double reach, const int* pieces, int count) const;
  /// Has the processor fetch what feet() looks at first of these pieces, while others are looked at: worth it
  /// for walls that do not stay in its cache.
  void prefetch(const int* pieces, int count) const;
  bool outgrows_cache() const { return surface_.pieces.size() > kInCache; }
  /// Appends the feet of d nearer than `reach`, given all pieces that are (more do no harm).
  void feet(const Vector3& d, double reach, const int* pieces, int count, std::vector<Foot>& out) const;

  /// Distance below which two points of a wall are the same [length].
  double same_point() const { return same_point_; }

 private:
  static constexpr size_t kInCache = 500;  // pieces

  const Surface& surface_;
  PieceTree tree_;
  std::vector<PlaneTriangle> triangles_;
  SmoothNeighbours neighbours_;
  double same_point_;
};

}  // namespace brep
