// SPDX-License-Identifier: GPL-2.0-or-later
// The control points of one patch, where somebody else keeps them.
#pragma once

#include "nurbs/assert.h"
#include "search/names.h"

namespace search {

/// Columns of a matrix (3 x n) that must outlive this.  Its numbers may change, and where they are stored.
class PatchPoints {
 public:
  /// All columns, of a surface of one patch.
  PatchPoints(const NodalVectors& points) : PatchPoints(points, 0, points.cols()) {}
  PatchPoints(const NodalVectors& points, Eigen::Index first, Eigen::Index count)
      : points_(&points), first_(first), count_(count) {}
  PatchPoints(const NodalVectors&&) = delete;  // it would be gone when it is looked at
  PatchPoints(const NodalVectors&&, Eigen::Index, Eigen::Index) = delete;

  Eigen::Index cols() const { return count_; }
  const double* data() const {
    NURBS_ASSERT(first_ + count_ <= points_->cols(), first_, count_, points_->cols());
    return points_->data() + 3 * first_;
  }
  auto col(Eigen::Index a) const { return points_->col(first_ + a); }
  Eigen::Map<const NodalVectors> matrix() const { return {data(), 3, count_}; }

 private:
  const NodalVectors* points_;
  Eigen::Index first_, count_;
};

}  // namespace search
