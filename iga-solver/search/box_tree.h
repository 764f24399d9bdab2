// SPDX-License-Identifier: GPL-2.0-or-later
// Global search: axis-aligned boxes of surface elements and a tree over them.
// A NURBS element with positive weights lies in the convex hull of its control points, so the box of these
// encloses it (Piegl & Tiller 1997, P4.8; Gao & Feng 2019, section 4.1, with a tree in place of their CGRID).
#pragma once

#include <vector>

#include "search/box_units.h"
#include "search/names.h"

namespace search {

/// Axis-aligned box [length].
struct Box {
  Vector3 low, high;
  void inflate(double by) { low.array() -= by, high.array() += by; }
  bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  /// Squared distance of a point from the box, 0 inside [length^2].
  double squared_distance(const Vector3& point) const {
    return (low - point).cwiseMax(point - high).cwiseMax(0.0).squaredNorm();
  }
};

/// Box of the control points of one element.
Box element_box(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points, int element);
/// Adds the boxes of all elements, in element order.
void add_element_boxes(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
                       std::vector<Box>& out);

/// Bounding-volume hierarchy over boxes: built in O(n log n), queried in O(log n + hits).
class BoxTree {
 public:
  /// Rebuilds over the boxes; their order gives the indices that query returns.
  void build(const std::vector<Box>& boxes);
  /// Appends the indices, in rising order, of all boxes not farther than `reach` from `point`, and of some
  /// that are farther by no more than round-off in single precision.
  void query(const Vector3& point, double reach, std::vector<int>& out) const;
  /// Box of everything; undefined while empty.
  const Box& bounds() const { return bounds_; }
  bool empty() const { return nodes_.empty(); }

 private:
  static constexpr int kChildren = 4;

  struct Node {
    BoxLanes<kChildren> boxes;
    int count;                // of the children
    int children[kChildren];  // a node, or ~index of a box
  };
  struct Range {
    int begin, end;  // in order_
    int half() const { return begin + (end - begin) / 2; }
  };
  Box bounds_of(const std::vector<Box>& boxes, Range range) const;
  void halve(const std::vector<Box>& boxes, Range range);
  void split(const std::vector<Box>& boxes, int node, Range range);

  BoxUnits units_;
  Box bounds_;
  std::vector<Node> nodes_;
  std::vector<int> order_;  // indices of the boxes while the tree is built
};

}  // namespace search
