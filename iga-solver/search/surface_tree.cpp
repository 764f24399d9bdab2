// SPDX-License-Identifier: GPL-2.0-or-later
#include "search/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace search {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Bounds {
  Vector4 low = Vector4::Constant(kInfinity), high = Vector4::Constant(-kInfinity);
  void add(const Bounds& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

}  // namespace

SurfaceTree::SurfaceTree(const Space<2>& space)
    : degree_{space.degree(0), space.degree(1)}, control_points_0_(space.control_point_count(0)) {
  for (int i = 0; i < 2; ++i) {
    const KnotVector& knots = space.knots(i);
    elements_[i] = knots.element_count();
    for (int e = 0; e < elements_[i]; ++e) first_[i].push_back(knots.span_of_element(e) - degree_[i]);
  }
  int count[2] = {elements_[0], elements_[1]};
  do {
    for (int& n : count) n = (n + 3) / 4;
    levels_.push_back({{count[0], count[1]}, std::vector<BoxLanes<16>>(count[0] * count[1])});
  } while (count[0] * count[1] > 1);
}

void SurfaceTree::refit(const Eigen::Ref<const NodalVectors>& control_points) {
  units_.set(control_points.rowwise().minCoeff(), control_points.rowwise().maxCoeff());
  fit_elements(control_points);
  for (size_t level = 1; level < levels_.size(); ++level) {
    const Level& below = levels_[level - 1];
    Level& here = levels_[level];
    for (int b = 0; b < below.count[1]; ++b)
      for (int a = 0; a < below.count[0]; ++a) {
        const ElementBlock block{static_cast<int>(level), {a, b}};
        Vector3 low = Vector3::Constant(kInfinity), high = -low;
        for (int k = 0; k < 16; ++k) {
          const ElementWindow own = elements(child(block, k));
          if (own.begin[0] >= own.end[0] || own.begin[1] >= own.end[1]) continue;
          const Vector3 middle = children(block).middle(k), half = children(block).half(k);
          low = low.cwiseMin(middle - half);
          high = high.cwiseMax(middle + half);
        }
        here.children[a / 4 + here.count[0] * (b / 4)].set(a % 4 + 4 * (b % 4), low, high);
      }
  }
}

// A box over (p+1) x (q+1) control points is one over q+1 boxes of p+1 in a row.
void SurfaceTree::fit_elements(const Eigen::Ref<const NodalVectors>& control_points) {
  const int p = degree_[0], q = degree_[1], n = elements_[0];
  std::vector<Bounds> rows(static_cast<size_t>(n) * (q + 1));  // of the last q+1 rows, row j at j % (q+1)
  std::vector<Bounds> points(control_points_0_);
  Level& level = levels_[0];
  int done = 0;
  for (int e1 = 0; e1 < elements_[1]; ++e1) {
    for (; done <= first_[1][e1] + q; ++done) {
      for (int c = 0; c < control_points_0_; ++c) {
        const auto x = control_points.col(c + control_points_0_ * done);
        points[c].low = points[c].high = Vector4(x[0], x[1], x[2], 0.0);
      }
      for (int e0 = 0; e0 < n; ++e0) {
        Bounds row = points[first_[0][e0]];
        for (int c = 1; c <= p; ++c) row.add(points[first_[0][e0] + c]);
        rows[e0 + n * (done % (q + 1))] = row;
      }
    }
    for (int e0 = 0; e0 < n; ++e0) {
      Bounds box = rows[e0];
      for (int j = 1; j <= q; ++j) box.add(rows[e0 + n * j]);
      level.children[e0 / 4 + level.count[0] * (e1 / 4)].set(
          e0 % 4 + 4 * (e1 % 4), units_.in_units(box.low.head<3>()), units_.in_units(box.high.head<3>()));
    }
  }
}

void SurfaceTree::query(const Vector3& d, double reach, int first, std::vector<int>& out) const {
  const Point at = point(d);
  if (!std::isfinite(at.far)) return;
  const auto old_size = static_cast<std::ptrdiff_t>(out.size());
  add_near(root(), at, units_.limit_with(at, reach), first, out);
  std::sort(out.begin() + old_size, out.end());
}

void SurfaceTree::add_near(const ElementBlock& block, const Point& point, float limit, int first,
                           std::vector<int>& out) const {
  const unsigned near = below(near2(block, point), limit);
  for (int k = 0; near >> k != 0; ++k) {
    if ((near >> k & 1) == 0) continue;
    const ElementBlock child = this->child(block, k);
    if (child.level == 0)
      out.push_back(first + child.at[0] + elements_[0] * child.at[1]);
    else
      add_near(child, point, limit, first, out);
  }
}

}  // namespace search
