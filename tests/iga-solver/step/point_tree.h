// SPDX-License-Identifier: GPL-2.0-or-later
// Which of many points are near one: a k-d tree, halved at the middle point along the longest side.
// Source: Bentley (1975), "Multidimensional binary search trees used for associative searching".
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <vector>

namespace step_parts {

class PointTree {
 public:
  using Point = std::array<double, 3>;

  explicit PointTree(std::vector<Point> points)
      : points_(std::move(points)), order_(points_.size()), cuts_(points_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) split(0, static_cast<int>(order_.size()));
  }

  /// Squared distance of the nearest.
  double nearest(const Point& p) const {
    double least = std::numeric_limits<double>::infinity();
    visit(0, static_cast<int>(order_.size()), p, least,
          [&](int, double away) { least = std::min(least, away); });
    return least;
  }
  /// Numbers of those within `reach`, with their squared distances.
  void within(const Point& p, double reach, std::vector<std::pair<double, int>>& found) const {
    const double square = reach * reach;
    visit(0, static_cast<int>(order_.size()), p, square, [&](int k, double away) {
      if (away <= square) found.emplace_back(away, k);
    });
  }

 private:
  static constexpr int kLeaf = 8;
  static int middle(int begin, int end) { return begin + (end - begin) / 2; }

  void split(int begin, int end) {
    if (end - begin <= kLeaf) return;
    Point low = points_[order_[begin]], high = low;
    for (int k = begin; k < end; ++k)
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], points_[order_[k]][i]);
        high[i] = std::max(high[i], points_[order_[k]][i]);
      }
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
    const int mid = middle(begin, end);
    std::nth_element(order_.begin() + begin, order_.begin() + mid, order_.begin() + end,
                     [&](int a, int b) { return points_[a][axis] < points_[b][axis]; });
    cuts_[mid] = {axis, points_[order_[mid]][axis]};
    split(begin, mid);
    split(mid, end);
  }

  // Those of the range that are nearer than `limit`, which may become less.
  template <class See>
  void visit(int begin, int end, const Point& p, const double& limit, const See& see) const {
    if (end - begin <= kLeaf) {
      for (int k = begin; k < end; ++k) {
        double away = 0.0;
        for (int i = 0; i < 3; ++i) away += (points_[order_[k]][i] - p[i]) * (points_[order_[k]][i] - p[i]);
        see(order_[k], away);
      }
      return;
    }
    const int mid = middle(begin, end);
    const double beyond = p[cuts_[mid].axis] - cuts_[mid].at;
    const auto half = [&](bool upper) { visit(upper ? mid : begin, upper ? end : mid, p, limit, see); };
    half(beyond >= 0.0);
    if (beyond * beyond <= limit) half(beyond < 0.0);
  }

  struct Cut {
    int axis;
    double at;
  };
  std::vector<Point> points_;
  std::vector<int> order_;
  std::vector<Cut> cuts_;  // of ranges, by their middle
};

}  // namespace step_parts
