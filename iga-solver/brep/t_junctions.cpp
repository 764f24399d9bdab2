// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/t_junctions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "brep/sides.h"

namespace brep {
namespace {

using Triangle = std::array<int, 3>;
using OnSides = std::array<std::vector<int>, 3>;  // points on each side of a triangle, in its direction

// Points in the cells of a grid, about one in each cell that a surface goes through.
class PointGrid {
 public:
  PointGrid(const NodalVectors& points, const std::vector<int>& numbers, double tolerance)
      : points_(points), tolerance_(tolerance), low_(points.rowwise().minCoeff()) {
    const double size = (points.rowwise().maxCoeff() - low_).norm();
    cell_ = std::max(size / std::sqrt(static_cast<double>(numbers.size())), 4.0 * tolerance);
    sorted_.reserve(numbers.size());
    for (const int p : numbers) sorted_.emplace_back(cell_of(points.col(p)), p);
    std::sort(sorted_.begin(), sorted_.end());
    sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
  }

  /// Those within the tolerance of the line from a to b, and by more than that between these, in this order.
  void between(int a, int b, std::vector<std::pair<double, int>>& found) const {
    found.clear();
    const Vector3 from = points_.col(a), way = points_.col(b) - from;
    const double length = way.norm();
    const auto parts = static_cast<int>(std::ceil(length / cell_));
    for (int part = 0; part < parts; ++part) {
      const double begin = part * length / parts, end = (part + 1) * length / parts;
      add(from, way / length, std::max(begin, std::nextafter(tolerance_, length)),
          part + 1 < parts ? end : length - tolerance_, found);
    }
    std::sort(found.begin(), found.end());
  }

 private:
  using Cell = std::array<int, 3>;
  Cell cell_of(const Vector3& x) const {
    Cell cell;
    for (int i = 0; i < 3; ++i) cell[i] = static_cast<int>(std::floor((x[i] - low_[i]) / cell_));
    return cell;
  }

  // Of the part of a line from `begin` to before `end`.
  void add(const Vector3& from, const Vector3& along, double begin, double end,
           std::vector<std::pair<double, int>>& found) const {
    const Vector3 p = from + begin * along, q = from + end * along;
    const Cell low = cell_of(p.cwiseMin(q).array() - tolerance_),
               high = cell_of(p.cwiseMax(q).array() + tolerance_);
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j) {
        auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::make_pair(Cell{i, j, low[2]}, -1));
        for (; at != sorted_.end() && at->first <= Cell{i, j, high[2]}; ++at) {
          const Vector3 to = points_.col(at->second) - from;
          const double t = along.dot(to);
          if (t >= begin && t < end && (to - t * along).norm() <= tolerance_)
            found.emplace_back(t, at->second);
        }
      }
  }

  const NodalVectors& points_;
  double tolerance_, cell_;
  Vector3 low_;
  std::vector<std::pair<Cell, int>> sorted_;
};

// A fan from the corner opposite to a side over the points on it; then the other sides, of its ends.
void cut(const Triangle& t, const OnSides& on, int number, CutTriangles& out) {
  int i = 0;
  while (i < 3 && on[i].empty()) ++i;
  if (i == 3) {
    out.corners.push_back(t);
    out.number.push_back(number);
    return;
  }
  const int b = t[(i + 1) % 3], opposite = t[(i + 2) % 3];
  int last = t[i];
  OnSides begin, end;
  begin[2] = on[(i + 2) % 3];
  end[1] = on[(i + 1) % 3];
  for (const int next : on[i]) {
    cut({last, next, opposite}, begin, number, out);
    begin[2].clear();
    last = next;
  }
  cut({last, b, opposite}, end, number, out);
}

std::vector<int> ends_of_free_sides(const std::vector<Triangle>& triangles, const MatchedSides& matched) {
  std::vector<int> ends;
  for (size_t e = 0; e + 1 < matched.first.size(); ++e) {
    if (matched.first[e + 1] - matched.first[e] != 1) continue;
    const int side = matched.sides[matched.first[e]];
    for (const int i : {0, 1}) ends.push_back(triangles[piece_of_side(side)][(side % 4 + i) % 3]);
  }
  return ends;
}

}  // namespace

CutTriangles cut_at_t_junctions(const NodalVectors& points, const std::vector<Triangle>& triangles,
                                const MatchedSides& matched, double tolerance) {
  CutTriangles result;
  const std::vector<int> free_ends = ends_of_free_sides(triangles, matched);
  if (free_ends.empty()) {
    result.corners = triangles;
    result.number.resize(triangles.size());
    std::iota(result.number.begin(), result.number.end(), 0);
    return result;
  }
  const PointGrid ends(points, free_ends, tolerance);
  std::vector<OnSides> on(triangles.size());
  std::vector<std::pair<double, int>> found;
  for (size_t e = 0; e + 1 < matched.first.size(); ++e) {
    const int first = matched.sides[matched.first[e]];
    const int a = triangles[piece_of_side(first)][first % 4],
              b = triangles[piece_of_side(first)][(first % 4 + 1) % 3];
    ends.between(a, b, found);
    for (int k = matched.first[e]; k < matched.first[e + 1] && !found.empty(); ++k) {
      const int t = piece_of_side(matched.sides[k]), i = matched.sides[k] % 4;
      std::vector<int>& on_side = on[t][i];
      for (const auto& [place, point] : found)
        if (point != triangles[t][(i + 2) % 3]) on_side.push_back(point);  // else it is thin itself
      if (triangles[t][i] != a) std::reverse(on_side.begin(), on_side.end());
      result.junctions += static_cast<int>(on_side.size());
    }
  }
  for (size_t t = 0; t < triangles.size(); ++t) cut(triangles[t], on[t], static_cast<int>(t), result);
  return result;
}

}  // namespace brep
