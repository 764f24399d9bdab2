// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/t_junctions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "brep/sides.h"
#include "nurbs/point_grid.h"

namespace brep {
namespace {

using Triangle = std::array<int, 3>;
using OnSides = std::array<std::vector<int>, 3>;  // points on each side of a triangle, in its direction

// Of each point: the least height of the triangles there [length].  A needle has none of its own: it may be
// what rounding left of three points on a line.
std::vector<double> least_heights(const NodalVectors& points, const std::vector<Triangle>& triangles) {
  constexpr double kNeedle = 0.01;  // height to length
  std::vector<double> least(points.cols(), std::numeric_limits<double>::infinity());
  for (const Triangle& t : triangles) {
    const Vector3 a = points.col(t[1]) - points.col(t[0]), b = points.col(t[2]) - points.col(t[0]);
    const double longest = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()}));
    const double height = a.cross(b).norm() / longest;
    if (height < kNeedle * longest) continue;
    for (const int p : t) least[p] = std::min(least[p], height);
  }
  return least;
}

// The corners that are looked for, in a grid with some in each cell that a surface goes through.
class FreeCorners {
 public:
  FreeCorners(const NodalVectors& points, const std::vector<Triangle>& triangles,
              const std::vector<int>& numbers, double tolerance)
      : points_(points),
        least_heights_(least_heights(points, triangles)),
        tolerance_(tolerance),
        reach_(reach_of(points, numbers.size(), tolerance)),
        grid_(reach_, numbers.size(), points.rowwise().minCoeff()) {
    for (const int p : numbers) grid_.add(p, points.col(p));
  }

  /// Those within the tolerance of the line from a to b, and by more than that between these, in this order.
  /// Where triangles are as small as the tolerance, it is a part of their height: they are no rounding.
  void between(int a, int b, std::vector<std::pair<double, int>>& found) const {
    found.clear();
    const Vector3 from = points_.col(a), way = points_.col(b) - from;
    const double length = way.norm();
    const Vector3 along = way / length;
    const double beside = std::min(least_heights_[a], least_heights_[b]);
    const auto parts = static_cast<int>(std::ceil(length / reach_));  // each in reach of its middle
    for (int part = 0; part < parts; ++part)
      grid_.for_each_near(from + (part + 0.5) / parts * way, [&](int p) {
        const Vector3 to = points_.col(p) - from;
        const double t = along.dot(to);
        const double near = std::min(tolerance_, kOfHeight * std::min(beside, least_heights_[p]));
        if (t > near && t < length - near && (to - t * along).norm() <= near) found.emplace_back(t, p);
      });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());  // in reach of two
  }

 private:
  static double reach_of(const NodalVectors& points, size_t count, double tolerance) {
    constexpr double kReach = 0.25;
    const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
    return std::max(kReach * size / std::sqrt(static_cast<double>(count)), 4.0 * tolerance);
  }

  static constexpr double kOfHeight = 0.1;

  const NodalVectors& points_;
  std::vector<double> least_heights_;
  double tolerance_, reach_;  // [length]
  nurbs::PointGrid grid_;
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
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
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
  const FreeCorners corners(points, triangles, free_ends, tolerance);
  std::vector<OnSides> on(triangles.size());
  std::vector<std::pair<double, int>> found;
  for (size_t e = 0; e + 1 < matched.first.size(); ++e) {
    const int first = matched.sides[matched.first[e]];
    const int a = triangles[piece_of_side(first)][first % 4],
              b = triangles[piece_of_side(first)][(first % 4 + 1) % 3];
    corners.between(a, b, found);
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
