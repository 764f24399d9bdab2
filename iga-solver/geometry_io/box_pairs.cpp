// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/box_pairs.h"

#include <algorithm>
#include <numeric>

namespace geometry_io {
namespace {

using search::Box;

constexpr int kLeaf = 4;  // boxes at most

class BoxTree {
 public:
  BoxTree(const std::vector<Box>& boxes, const std::function<void(int, int)>& visit)
      : boxes_(boxes), visit_(visit), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.reserve(boxes.size());
    if (!boxes.empty()) within(build(0, static_cast<int>(boxes.size())));
  }

 private:
  struct Node {
    Box box;
    int begin, end;             // of order_
    int left = -1, right = -1;  // -1: a leaf
    bool leaf() const { return left < 0; }
    int count() const { return end - begin; }
  };

  int build(int begin, int end) {
    Box box = boxes_[order_[begin]], middles{box.low + box.high, box.low + box.high};
    for (int i = begin + 1; i < end; ++i) {
      const Box& one = boxes_[order_[i]];
      box.low = box.low.cwiseMin(one.low);
      box.high = box.high.cwiseMax(one.high);
      middles.low = middles.low.cwiseMin(one.low + one.high);
      middles.high = middles.high.cwiseMax(one.low + one.high);
    }
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back({box, begin, end});
    if (end - begin <= kLeaf) return node;
    int axis;
    (middles.high - middles.low).maxCoeff(&axis);
    const int half = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end, [&](int a, int b) {
      return boxes_[a].low[axis] + boxes_[a].high[axis] < boxes_[b].low[axis] + boxes_[b].high[axis];
    });
    const int left = build(begin, half), right = build(half, end);
    nodes_[node].left = left;
    nodes_[node].right = right;
    return node;
  }

  void within(int n) const {
    const Node& node = nodes_[n];
    if (!node.leaf()) {
      within(node.left);
      within(node.right);
      between(node.left, node.right);
      return;
    }
    for (int i = node.begin; i < node.end; ++i)
      for (int j = i + 1; j < node.end; ++j) look_at(order_[i], order_[j]);
  }

  void between(int a, int b) const {
    const Node &one = nodes_[a], &other = nodes_[b];
    if (!one.box.overlaps(other.box)) return;
    if (one.leaf() && other.leaf()) {
      for (int i = one.begin; i < one.end; ++i)
        for (int j = other.begin; j < other.end; ++j) look_at(order_[i], order_[j]);
    } else if (other.leaf() || (!one.leaf() && one.count() >= other.count())) {
      between(one.left, b);
      between(one.right, b);
    } else {
      between(a, other.left);
      between(a, other.right);
    }
  }

  void look_at(int i, int j) const {
    if (boxes_[i].overlaps(boxes_[j])) visit_(i, j);
  }

  const std::vector<Box>& boxes_;
  const std::function<void(int, int)>& visit_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace

void for_box_pairs(const std::vector<Box>& boxes, const std::function<void(int, int)>& visit) {
  BoxTree(boxes, visit);
}

}  // namespace geometry_io
