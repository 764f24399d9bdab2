// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nurbs {
namespace {

constexpr int kLeafSize = 4;
constexpr int kMaxDepth = 64;  // halving a range of ints reaches the leaves after 31 levels

}  // namespace

Box element_box(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points, int element) {
  int indices[power(kMaxDegree + 1, 2)];
  space.element_control_points(element, indices);
  Box box{control_points.col(indices[0]), control_points.col(indices[0])};
  for (int a = 1; a < space.functions_per_element(); ++a) {
    box.low = box.low.cwiseMin(control_points.col(indices[a]));
    box.high = box.high.cwiseMax(control_points.col(indices[a]));
  }
  return box;
}

void element_boxes(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
                   std::vector<Box>& out) {
  out.resize(space.element_count());
  for (int e = 0; e < space.element_count(); ++e) out[e] = element_box(space, control_points, e);
}

void BoxTree::build(std::vector<Box> boxes) {
  boxes_ = std::move(boxes);
  nodes_.clear();
  order_.resize(boxes_.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (boxes_.empty()) return;
  nodes_.emplace_back();
  split(0, 0, static_cast<int>(boxes_.size()));
  std::vector<Box> in_order(boxes_.size());  // those of a leaf one after another
  for (size_t i = 0; i < boxes_.size(); ++i) in_order[i] = boxes_[order_[i]];
  boxes_.swap(in_order);
}

// Halves the range at the median of the box centres along the longest side.
void BoxTree::split(int node, int begin, int end) {
  Box bounds = boxes_[order_[begin]];
  for (int i = begin + 1; i < end; ++i) {
    bounds.low = bounds.low.cwiseMin(boxes_[order_[i]].low);
    bounds.high = bounds.high.cwiseMax(boxes_[order_[i]].high);
  }
  if (end - begin <= kLeafSize) {
    nodes_[node] = {bounds, begin, end - begin};
    return;
  }
  int axis;
  (bounds.high - bounds.low).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  const auto before = [&](int a, int b) {
    return boxes_[a].low[axis] + boxes_[a].high[axis] < boxes_[b].low[axis] + boxes_[b].high[axis];
  };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, before);

  const int children = static_cast<int>(nodes_.size());
  nodes_[node] = {bounds, children, 0};
  nodes_.resize(nodes_.size() + 2);
  split(children, begin, middle);
  split(children + 1, middle, end);
}

void BoxTree::query(const Vector3& point, double reach, std::vector<int>& out) const {
  if (empty()) return;
  const size_t old_size = out.size();
  // Along one direction first: most boxes are too far in one.
  const auto near = [&](const Box& box) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double away = std::max(std::max(box.low[i] - point[i], point[i] - box.high[i]), 0.0);
      sum += away * away;
    }
    return sum <= reach * reach;
  };
  int stack[kMaxDepth], depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (node.count == 0)
      for (const int child : {node.first, node.first + 1})
        if (near(nodes_[child].box)) stack[depth++] = child;
    for (int i = node.first; i < node.first + node.count; ++i)
      if (near(boxes_[i])) out.push_back(order_[i]);
  }
  std::sort(out.begin() + old_size, out.end());
}

}  // namespace nurbs
