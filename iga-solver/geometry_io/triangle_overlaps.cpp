// SPDX-License-Identifier: GPL-2.0-or-later
// Two triangles pierce each other if each has corners on both sides of the other's plane and the segment that
// both cut out of the line of these planes runs inside both.  Source: Moeller (1997), "A fast
// triangle-triangle intersection test".  Two in one plane are cut by each other's sides: Sutherland & Hodgman
// (1974), "Reentrant polygon clipping".
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry_io/box_pairs.h"
#include "geometry_io/triangle_mesh.h"

namespace geometry_io {
namespace {

using nurbs::Vector3;

struct FlatTriangle {
  std::array<Vector3, 3> corner;
  Vector3 normal;               // unit
  double lowest_height;         // of its three [length]
  std::array<Vector3, 3> into;  // unit, in its plane, across the side from corner i on

  FlatTriangle(const Vector3& a, const Vector3& b, const Vector3& c) : corner{a, b, c} {
    const Vector3 twice_area = (b - a).cross(c - a);
    double longest = 0.0;
    normal = twice_area.normalized();
    for (int i = 0; i < 3; ++i) {
      const Vector3 side = corner[(i + 1) % 3] - corner[i];
      longest = std::max(longest, side.norm());
      into[i] = normal.cross(side).normalized();
    }
    lowest_height = longest > 0.0 ? twice_area.norm() / longest : 0.0;
  }
  std::array<double, 3> heights(const FlatTriangle& other) const {
    std::array<double, 3> h;
    for (int i = 0; i < 3; ++i) h[i] = normal.dot(other.corner[i] - corner[0]);
    return h;
  }
  // How far a point of its plane is inside [length].
  double depth(const Vector3& x) const {
    double least = into[0].dot(x - corner[0]);
    for (int i = 1; i < 3; ++i) least = std::min(least, into[i].dot(x - corner[i]));
    return least;
  }
};

bool within(const std::array<double, 3>& h, double tolerance) {
  return std::max({std::abs(h[0]), std::abs(h[1]), std::abs(h[2])}) <= tolerance;
}
bool on_both_sides(const std::array<double, 3>& h, double tolerance) {
  const auto [low, high] = std::minmax({h[0], h[1], h[2]});
  return low < -tolerance && high > tolerance;
}

// Where a triangle with corners on both sides of a plane, at these heights, meets it.
std::array<Vector3, 2> cut(const FlatTriangle& t, const std::array<double, 3>& h) {
  std::array<Vector3, 2> ends;
  int count = 0;
  for (int i = 0; i < 3 && count < 2; ++i) {
    const int j = (i + 1) % 3;
    if ((h[i] > 0.0) != (h[j] > 0.0))
      ends[count++] = t.corner[i] + h[i] / (h[i] - h[j]) * (t.corner[j] - t.corner[i]);
  }
  return ends;
}

// Heights: of each one's corners over the other.
bool pierce(const FlatTriangle& a, const FlatTriangle& b, const std::array<double, 3>& ha,
            const std::array<double, 3>& hb, double tolerance) {
  if (!on_both_sides(ha, tolerance) || !on_both_sides(hb, tolerance)) return false;
  const std::array<Vector3, 2> p = cut(a, ha), q = cut(b, hb);
  const Vector3 along = (p[1] - p[0]).normalized();
  const auto [begin, end] = std::minmax({along.dot(q[0] - p[0]), along.dot(q[1] - p[0])});
  const double low = std::max(0.0, begin), high = std::min((p[1] - p[0]).norm(), end);
  const Vector3 middle = p[0] + 0.5 * (low + high) * along;
  return high > low && a.depth(middle) > tolerance && b.depth(middle) > tolerance;
}

// A convex polygon; room for the sign changes that round-off may add to a sliver (3, 4, 6, 9).
struct Polygon {
  std::array<Vector3, 9> corner;
  int count = 0;
};

Polygon clipped(const Polygon& polygon, const Vector3& into, const Vector3& origin) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vector3 &x = polygon.corner[i], &y = polygon.corner[(i + 1) % polygon.count];
    const double h = into.dot(x - origin), k = into.dot(y - origin);
    if (h >= 0.0) kept.corner[kept.count++] = x;
    if ((h >= 0.0) != (k >= 0.0)) kept.corner[kept.count++] = x + h / (h - k) * (y - x);
  }
  return kept;
}

// Whether all of b is beyond a side of a, but for the tolerance.
bool beyond_a_side(const FlatTriangle& a, const FlatTriangle& b, double tolerance) {
  for (int i = 0; i < 3; ++i) {
    double inside = 0.0;
    for (const Vector3& x : b.corner) inside = std::max(inside, a.into[i].dot(x - a.corner[i]));
    if (inside <= tolerance) return true;
  }
  return false;
}

// Whether b, seen along the normal of a, covers part of a that is wider than the tolerance.
bool cover(const FlatTriangle& a, const FlatTriangle& b, double tolerance) {
  if (beyond_a_side(a, b, tolerance) || beyond_a_side(b, a, tolerance)) return false;
  Polygon common{{b.corner[0], b.corner[1], b.corner[2]}, 3};
  for (int i = 0; i < 3 && common.count > 0; ++i) common = clipped(common, a.into[i], a.corner[i]);
  Vector3 twice_area = Vector3::Zero();
  double around = 0.0;
  for (int i = 0; i < common.count; ++i) {
    const Vector3 side = common.corner[(i + 1) % common.count] - common.corner[i];
    twice_area += (common.corner[i] - common.corner[0]).cross(side);
    around += side.norm();
  }
  return twice_area.norm() > tolerance * around;  // of a strip: its width
}

void add_pair(OverlappingPairs& pairs, int i, int j) {
  const auto [first, second] = std::minmax(i, j);
  if (pairs.count++ == 0 || std::tie(first, second) < std::tie(pairs.first, pairs.second))
    pairs.first = first, pairs.second = second;
}

}  // namespace

Overlaps overlaps_of(const TriangleMesh& mesh) {
  const double tolerance =
      kSamePoint * (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  std::vector<FlatTriangle> triangles;
  std::vector<search::Box> boxes;
  std::vector<int> number;
  for (int t = 0; t < mesh.count(); ++t) {
    const int* c = &mesh.triangles[3 * t];
    const FlatTriangle triangle(mesh.points.col(c[0]), mesh.points.col(c[1]), mesh.points.col(c[2]));
    if (triangle.lowest_height <= tolerance) continue;  // its plane is unsure
    const auto& x = triangle.corner;
    boxes.push_back({x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])});
    boxes.back().inflate(tolerance);
    triangles.push_back(triangle);
    number.push_back(t);
  }
  Overlaps overlaps;
  for_box_pairs(boxes, [&](int i, int j) {
    const FlatTriangle &a = triangles[i], &b = triangles[j];
    const std::array<double, 3> hb = a.heights(b), ha = b.heights(a);
    if (within(hb, tolerance) ? cover(a, b, tolerance) : within(ha, tolerance) && cover(b, a, tolerance))
      add_pair(overlaps.in_plane, number[i], number[j]);
    else if (pierce(a, b, ha, hb, tolerance))
      add_pair(overlaps.piercing, number[i], number[j]);
  });
  return overlaps;
}

}  // namespace geometry_io
