// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/tessellation.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "nurbs/primitives.h"

namespace nurbs {
namespace {

const Frame kUpright = frame(Vector3(1.0, 2.0, 3.0), Vector3(0.3, -0.2, 1.0));

/// How often each edge is run through from a to b; a closed surface has every edge once in each sense.
std::map<std::pair<int, int>, int> half_edges(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const std::array<int, 3>& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
  return count;
}

int open_edges(const TriangleMesh& mesh) {
  const auto edges = half_edges(mesh);
  int open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1) << "two triangles on the same side of an edge";
    open += edges.count({edge.second, edge.first}) == 0;
  }
  return open;
}

/// V - E + F of a closed surface: 2 for a sphere, 0 for a torus.
int euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<int>(mesh.vertices.cols()) - static_cast<int>(half_edges(mesh).size()) / 2 +
         static_cast<int>(mesh.triangles.size());
}

/// Enclosed volume by the divergence theorem; positive if the triangles' normals point outwards.
double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const std::array<int, 3>& t : mesh.triangles)
    sum += mesh.vertices.col(t[0]).dot(Vector3(mesh.vertices.col(t[1])).cross(mesh.vertices.col(t[2]))) / 6.0;
  return sum;
}

TEST(Tessellation, OfASphereIsClosedAtSeamAndPoles) {
  const Surface sphere =
      nurbs::sphere(kUpright, 2.0, refined(arc(0, 360), 8, 2), refined(arc(-90, 90), 4, 2));
  const TriangleMesh mesh = tessellate({sphere}, 3);
  EXPECT_EQ(open_edges(mesh), 0);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_EQ(mesh.triangles.size(), 24u * (2 * 12 - 2)) << "two triangles per cell, one beside a pole";
  for (int v = 0; v < mesh.vertices.cols(); ++v)
    EXPECT_NEAR((mesh.vertices.col(v) - kUpright.origin).norm(), 2.0, 1e-14);
}

TEST(Tessellation, OfATorusIsClosedAndConvergesToItsVolume) {
  const Surface torus = nurbs::torus(kUpright, 3.0, 1.0, arc(0, 360), arc(0, 360));
  EXPECT_EQ(open_edges(tessellate({torus}, 1)), 0);
  EXPECT_EQ(euler_characteristic(tessellate({torus}, 1)), 0);
  const double pi = std::acos(-1.0), exact = 2.0 * pi * pi * 3.0;
  const double coarse = exact - volume(tessellate({torus}, 8)),
               fine = exact - volume(tessellate({torus}, 16));
  EXPECT_GT(fine, 0.0) << "chords lie inside a convex meridian";
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Tessellation, WeldsPatchesAlongABorder) {
  const std::array<KnotVector, 2> knots{KnotVector::uniform(2, 2), KnotVector::uniform(3, 2)};
  const Surface left = plane({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, knots);
  const Surface right = plane({1, 0, 0}, {1, 0, 0.5}, {0, 1, 0}, knots);
  const TriangleMesh mesh = tessellate({left, right}, 2);
  EXPECT_EQ(mesh.vertices.cols(), 5 * 5 + 5 * 4);
  EXPECT_EQ(mesh.triangles.size(), 2u * 2 * 16);
  EXPECT_EQ(open_edges(mesh), 2 * (4 + 8));
}

TEST(Tessellation, KeepsThePatchesOrientation) {
  const std::array<KnotVector, 2> knots{KnotVector::uniform(1, 1), KnotVector::uniform(1, 1)};
  const TriangleMesh mesh = tessellate({plane({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, knots)}, 1);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (const std::array<int, 3>& t : mesh.triangles) {
    const Vector3 a = mesh.vertices.col(t[0]), b = mesh.vertices.col(t[1]), c = mesh.vertices.col(t[2]);
    EXPECT_EQ((b - a).cross(c - a), Vector3(0, 0, 2));
  }
}

TEST(Tessellation, NeedsACell) {
  EXPECT_THAT([] { tessellate({}, 0); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("1 or more")));
}

TEST(Tessellation, OfNothingIsEmpty) { EXPECT_TRUE(tessellate({}, 1).triangles.empty()); }

/// The farthest that the triangles are from a sphere of this radius, from points all over them.
double sagitta(const TriangleMesh& mesh, double radius) {
  constexpr int kPoints = 12;
  double largest = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    for (int i = 0; i <= kPoints; ++i)
      for (int j = 0; i + j <= kPoints; ++j) {
        const Vector3 point =
            (i * mesh.vertices.col(a) + j * mesh.vertices.col(b) + (kPoints - i - j) * mesh.vertices.col(c)) /
            kPoints;
        largest = std::max(largest, radius - (point - kUpright.origin).norm());
      }
  return largest;
}

TEST(Tessellation, KeepsWithinAChord) {
  const Surface sphere =
      nurbs::sphere(kUpright, 2.0, refined(arc(0, 360), 8, 2), refined(arc(-60, 90), 2, 2));
  for (const double chord : {0.1, 0.03, 0.01, 0.003}) {
    const int cells = cells_within({sphere}, chord);
    EXPECT_LE(sagitta(tessellate({sphere}, cells), 2.0), 1.01 * chord) << chord;
    EXPECT_GT(cells, 1);
    EXPECT_GT(sagitta(tessellate({sphere}, cells - 1), 2.0), 0.9 * chord) << chord << ": more than it takes";
  }
}

TEST(Tessellation, OfAPlaneKeepsWithinAnyChord) {
  const std::array<KnotVector, 2> knots = {KnotVector::uniform(2, 3), KnotVector::uniform(1, 2)};
  const Surface plane =
      nurbs::plane(Vector3(1.0, 2.0, 3.0), Vector3(1.0, 0.5, 0.0), Vector3(0.0, 0.3, 2.0), knots);
  EXPECT_EQ(cells_within({plane}, 1e-12), 1);
}

TEST(Tessellation, RefusesChordsThatTakeTooMuch) {
  const Surface sphere =
      nurbs::sphere(kUpright, 2.0, refined(arc(0, 360), 4, 2), refined(arc(-90, 90), 2, 2));
  EXPECT_THAT([&] { cells_within({sphere}, 1e-9); }, testing::ThrowsMessage<std::invalid_argument>(
                                                         testing::HasSubstr("cells per element, expected")));
  EXPECT_THROW(cells_within({sphere}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace nurbs
