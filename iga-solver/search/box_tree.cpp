// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/box_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace search {
namespace {

constexpr int kMaxStack = 64;  // quartering a range of ints reaches boxes after 16 levels; three wait on each

// Of a tree over so many boxes: one that is split twice into halves, as far as there are two.
int node_count(int boxes) {
  if (boxes < 2) return 0;
  int nodes = 1;
  for (const int half : {boxes / 2, boxes - boxes / 2})
    nodes += node_count(half / 2) + node_count(half - half / 2);
  return nodes;
}

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

void add_element_boxes(const Space<2>& space, const Eigen::Ref<const NodalVectors>& control_points,
                       std::vector<Box>& out) {
  for (int e = 0; e < space.element_count(); ++e) out.push_back(element_box(space, control_points, e));
}

void BoxTree::build(const std::vector<Box>& boxes) {
  nodes_.clear();
  if (boxes.empty()) return;
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  const Range all{0, static_cast<int>(boxes.size())};
  bounds_ = bounds_of(boxes, all);
  units_.set(bounds_.low, bounds_.high);
  nodes_.reserve(std::max(node_count(all.end), 1));
  nodes_.emplace_back();
  split(boxes, 0, all);
}

Box BoxTree::bounds_of(const std::vector<Box>& boxes, Range range) const {
  Box bounds = boxes[order_[range.begin]];
  for (int i = range.begin + 1; i < range.end; ++i) {
    bounds.low = bounds.low.cwiseMin(boxes[order_[i]].low);
    bounds.high = bounds.high.cwiseMax(boxes[order_[i]].high);
  }
  return bounds;
}

// At the median of the box centres along the longest side.
void BoxTree::halve(const std::vector<Box>& boxes, Range range) {
  const Box bounds = bounds_of(boxes, range);
  int axis;
  (bounds.high - bounds.low).maxCoeff(&axis);
  const auto before = [&](int a, int b) {
    return boxes[a].low[axis] + boxes[a].high[axis] < boxes[b].low[axis] + boxes[b].high[axis];
  };
  const auto first = order_.begin();
  std::nth_element(first + range.begin, first + range.half(), first + range.end, before);
}

// Twice into halves; a part of one box is that box.
void BoxTree::split(const std::vector<Box>& boxes, int node, Range range) {
  Range parts[kChildren] = {range};
  int count = 1;
  for (int twice = 0; twice < 2; ++twice)
    for (int k = count - 1; k >= 0; --k) {
      const Range part = parts[k];
      if (part.end - part.begin < 2) continue;
      halve(boxes, part);
      parts[k].end = part.half();
      parts[count++] = {part.half(), part.end};
    }
  nodes_[node].count = count;
  for (int k = 0; k < count; ++k) {
    const Range part = parts[k];
    const Box box = bounds_of(boxes, part);
    nodes_[node].boxes.set(k, units_.in_units(box.low), units_.in_units(box.high));
    const bool is_box = part.end - part.begin == 1;
    nodes_[node].children[k] = is_box ? ~order_[part.begin] : static_cast<int>(nodes_.size());
    if (is_box) continue;
    nodes_.emplace_back();
    split(boxes, nodes_[node].children[k], part);
  }
}

void BoxTree::query(const Vector3& point, double reach, std::vector<int>& out) const {
  if (empty()) return;
  const BoxUnits::Point at = units_.point(point);
  if (!std::isfinite(at.far)) return;
  const float limit = units_.limit(at, reach);
  const auto old_size = static_cast<std::ptrdiff_t>(out.size());
  int stack[kMaxStack], depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    const BoxLanes<kChildren>::Lanes away2 = node.boxes.near2(at);
    for (int k = 0; k < node.count; ++k) {
      if (!(away2[k] <= limit)) continue;
      const int child = node.children[k];
      if (child >= 0)
        stack[depth++] = child;
      else
        out.push_back(~child);
    }
  }
  std::sort(out.begin() + old_size, out.end());
}

}  // namespace search
