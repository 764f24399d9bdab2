// SPDX-License-Identifier: GPL-2.0-or-later
// Walls of triangles with corners on the sides of others have the feet of those without.
#include "brep/t_junctions.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "brep/foot_search.h"
#include "brep/summary.h"
#include "trials.h"

namespace brep {
namespace {

using trials::Wall;

constexpr double kExact = 1e-12, kNear = 1e-4;  // [length]

// Whether a corner would be taken to be on a side that it only lies near.
bool has_corners_nearly_on_sides(const Wall& wall) {
  for (const std::array<int, 3>& t : wall.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vector3 from = wall.points[t[i]], way = wall.points[t[(i + 1) % 3]] - from;
      for (const Vector3& x : wall.points) {
        const double place = std::clamp((x - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
        const double distance = (x - from - place * way).norm();
        if (distance > kExact && distance < kNear) return true;
      }
    }
  return false;
}

// Whether two triangles that bend a little could be taken for one plane: the larger one's, and which is
// larger depends on where they are divided.
bool has_sides_that_nearly_lie_in_a_plane(const Wall& wall) {
  const auto has = [](const std::array<int, 3>& triangle, int point) {
    return std::find(triangle.begin(), triangle.end(), point) != triangle.end();
  };
  for (const std::array<int, 3>& a : wall.triangles) {
    const Vector3 o = wall.points[a[0]],
                  n = (wall.points[a[1]] - o).cross(wall.points[a[2]] - o).normalized();
    for (const std::array<int, 3>& b : wall.triangles)
      for (int i = 0; i < 3; ++i) {
        const double height = std::abs(n.dot(wall.points[b[i]] - o));
        if (height > kExact && height < kNear && has(a, b[(i + 1) % 3]) && has(a, b[(i + 2) % 3]))
          return true;
      }
  }
  return false;
}

// Divides a side of a triangle, of it alone, at random places.
void divide_a_side(Wall& wall, std::mt19937& random) {
  const int t = trials::whole(random, 0, static_cast<int>(wall.triangles.size()) - 1);
  const int side = trials::whole(random, 0, 2), parts = trials::whole(random, 2, 4);
  const std::array<int, 3> triangle = wall.triangles[t];
  const int a = triangle[side], b = triangle[(side + 1) % 3], c = triangle[(side + 2) % 3];
  const Vector3 from = wall.points[a], way = wall.points[b] - from;
  wall.triangles.erase(wall.triangles.begin() + t);
  int last = a;
  for (int k = 1; k <= parts; ++k) {
    int next = b;
    if (k < parts) {
      next = static_cast<int>(wall.points.size());
      wall.points.push_back(from + (k - trials::uniform(random, 0.2, 0.8)) / parts * way);
    }
    wall.triangles.push_back({last, next, c});
    last = next;
  }
}

std::vector<Vector3> sorted_feet(const Surface& surface, const Vector3& d, double reach) {
  std::vector<Foot> feet = trials::feet(surface, d, reach);
  std::vector<Vector3> points;
  points.reserve(feet.size());
  for (const Foot& foot : feet) points.push_back(foot.point);
  std::sort(points.begin(), points.end(), [&](const Vector3& a, const Vector3& b) {
    return std::make_pair((a - d).norm(), a[0]) < std::make_pair((b - d).norm(), b[0]);
  });
  return points;
}

TEST(TJunctions, HaveTheFeetOfTheWallWithoutThem) {
  std::mt19937 random(11);
  int feet = 0, junctions = 0;
  for (int family = 0; family < trials::kFamilies; ++family)
    for (int k = 0; k < 8; ++k) {
      Wall whole = trials::random_wall(random, family);
      while (has_sides_that_nearly_lie_in_a_plane(whole)) whole = trials::random_wall(random, family);
      Wall divided = whole;
      for (int n = trials::whole(random, 1, 12); n > 0; --n) {
        const Wall before = divided;
        divide_a_side(divided, random);
        if (has_corners_nearly_on_sides(divided) || has_sides_that_nearly_lie_in_a_plane(divided))
          divided = before;
      }
      BuildReport report;
      const Surface expected = built(whole),
                    found = from_triangles(divided.coordinates(), divided.corners(), 0.02, &report);
      junctions += report.t_junctions;
      EXPECT_EQ(report.thin + report.collapsed, 0);
      EXPECT_EQ(summary_of(found).closed, summary_of(expected).closed);
      for (int n = 0; n < 100; ++n) {
        Vector3 d = trials::random_point(random, whole, n % trials::kPlaces);
        d += 1e-3 * expected.size * trials::random_direction(random);
        const std::vector<Vector3> a = sorted_feet(expected, d, 0.3 * expected.size),
                                   b = sorted_feet(found, d, 0.3 * expected.size);
        ASSERT_EQ(a.size(), b.size()) << "family " << family << ", wall " << k << ", point " << n;
        for (size_t i = 0; i < a.size(); ++i)
          ASSERT_LT((a[i] - b[i]).norm(), 1e-9 * expected.size) << "family " << family << ", point " << n;
        feet += static_cast<int>(a.size());
      }
    }
  EXPECT_GT(feet, 5000);
  EXPECT_GT(junctions, 200);
}

// Two floors whose corners lie on each other's borders.
TEST(TJunctions, JoinRowsThatOverlapOnALine) {
  Wall wall;
  for (int i = 0; i < 3; ++i)
    wall.add_quad({-1.0, i + 0.0, 0}, {0, i + 0.0, 0}, {0, i + 1.0, 0}, {-1.0, i + 1.0, 0});
  for (int i = 0; i < 2; ++i)
    wall.add_quad({0, 1.5 * i, 0}, {1, 1.5 * i, 0}, {1, 1.5 * i + 1.5, 0}, {0, 1.5 * i + 1.5, 0});
  BuildReport report;
  const Surface floor = from_triangles(wall.coordinates(), wall.corners(), 0.02, &report);
  EXPECT_EQ(report.t_junctions, 3);
  EXPECT_EQ(floor.faces.size(), 1u);
  EXPECT_NEAR(summary_of(floor).area, 6.0, 1e-14);
  for (const double y : {0.3, 0.99, 1.0, 1.25, 1.5, 2.0, 2.7})
    for (const double x : {-1e-3, 0.0, 1e-9}) EXPECT_EQ(trials::feet(floor, {x, y, 0.1}, 0.2).size(), 1u);
}

// As a file of six digits has them.
TEST(TJunctions, JoinWhatIsRounded) {
  for (const double off : {-4e-6, 4e-6, 4e-5}) {
    Wall wall;
    wall.add_quad({-1, 0, 0}, {0, 0, 0}, {0, 3, 0}, {-1, 3, 0});
    wall.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, off});
    wall.add_quad({0, 1, off}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0});
    BuildReport report;
    const Surface floor = from_triangles(wall.coordinates(), wall.corners(), 0.02, &report);
    const bool near = off < 1e-5 * floor.size;
    EXPECT_EQ(report.t_junctions, near ? 1 : 0);
    EXPECT_EQ(summary_of(floor).free, near ? 7 : 10);
    EXPECT_EQ(trials::feet(floor, {1e-3, 1.2, 0.1}, 0.2).size(), near ? 1u : 2u);
  }
}

// An open cap beside a floor so large that all of the cap is within the tolerance of its own sides.
TEST(TJunctions, LeaveSmallDetailsOfLargeFilesAlone) {
  for (const double width : {3e-3, 8e-4}) {
    Wall wall;
    wall.add_quad({-50, -0.5, 0}, {50, -0.5, 0}, {50, 0.5, 0}, {-50, 0.5, 0});
    const double height = width / 4;
    const Vector3 at(1, 0.25, 0), up(0, 0, height);
    const Vector3 rim[] = {at, at + Vector3(width, 0, 0), at + Vector3(width, width, 0),
                           at + Vector3(0, width, 0)};
    wall.add_quad(rim[0] + up, rim[1] + up, rim[2] + up, rim[3] + up);
    for (int i = 0; i < 4; ++i) {
      const Vector3 a = rim[i], b = rim[(i + 1) % 4], middle = 0.5 * (a + b);
      wall.add_triangle(a, middle, a + up);
      wall.add_triangle(middle, b, b + up);
      wall.add_triangle(middle, b + up, a + up);
    }
    BuildReport report;
    const Surface part = from_triangles(wall.coordinates(), wall.corners(), 0.02, &report);
    EXPECT_EQ(report.t_junctions, 0);
    EXPECT_EQ(part.faces.size(), 6u);
    EXPECT_NEAR(summary_of(part).area, 100.0 + width * (width + 4.0 * height), 1e-12);
    const Vector3 side = at + Vector3(0.4 * width, width + height / 4, height / 2);
    const auto feet = trials::feet(part, side, height / 3);
    ASSERT_EQ(feet.size(), 1u);
    EXPECT_LT((feet[0].point - side + Vector3(0, height / 4, 0)).norm(), 1e-12);
  }
}

// A side that is joined over a part of it alone is free elsewhere.
TEST(TJunctions, LeaveFreeWhatNothingLiesBeside) {
  Wall wall;
  wall.add_quad({-1, 0, 0}, {0, 0, 0}, {0, 3, 0}, {-1, 3, 0});
  wall.add_quad({0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0});
  const Surface floor = built(wall);
  EXPECT_EQ(floor.faces.size(), 1u);
  EXPECT_EQ(summary_of(floor).free, 8);
  const auto feet = trials::feet(floor, {0.1, 0.5, 0.05}, 0.2);
  ASSERT_EQ(feet.size(), 1u);
  EXPECT_LT((feet[0].point - Vector3(0, 0.5, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace brep
