// SPDX-License-Identifier: GPL-2.0-or-later
// Sheets, edges and vertices of simple walls of triangles.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "brep/summary.h"
#include "stl_trial.h"
#include "trials.h"

namespace brep {
namespace {

using trials::feet;

using testing::HasSubstr;
using trials::Wall;

TEST(Sheets, ACubeHasOneOutsideAndSixInside) {
  const Surface cube = built(trials::cube());
  EXPECT_EQ(cube.faces.size(), 6u);
  EXPECT_EQ(cube.edges.size(), 12u);
  EXPECT_EQ(cube.sheet_count, 7);
  std::set<int> outside;
  for (int f = 0; f < 6; ++f) outside.insert(cube.sheet(f, 1));
  EXPECT_EQ(outside.size(), 1u);
}

TEST(Sheets, AnLProfileIsOneSheetAroundItsEnds) {
  const Surface profile = built(trials::l_profile());
  EXPECT_EQ(profile.faces.size(), 8u);   // ends are L-shaped plane faces
  EXPECT_EQ(profile.edges.size(), 22u);  // with collinear pieces
  std::set<int> outside;
  for (size_t f = 0; f < profile.faces.size(); ++f) outside.insert(profile.sheet(static_cast<int>(f), 1));
  EXPECT_EQ(outside.size(), 1u);
  EXPECT_EQ(profile.sheet_count, 1 + 7);  // inside, the two faces of the corner are one
}

TEST(Sheets, AnOpenBoxHasItsInsidesJoinedOverTheRim) {
  const Surface box = built(trials::open_box());
  EXPECT_EQ(box.sheet_count, 2);  // the bottom's inside apart
}

TEST(Sheets, TwoPlatesThatCrossHaveASheetForEachSideOfEachWing) {
  const double right = 0.5 * 3.141592653589793;
  const Surface plates = built(trials::plates({0.0, right, 2.0 * right, 3.0 * right}));
  EXPECT_EQ(plates.edges.size(), 4u * 3 + 1);
  EXPECT_EQ(plates.sheet_count, 4);  // the wings' sides joined over their rims
  EXPECT_EQ(feet(plates, {0.1, 0.2, 0.5}, 0.3).size(), 2u);
  EXPECT_EQ(feet(plates, {-0.1, 0.2, 0.5}, 0.3).size(), 2u);
}

// Over a slit between two of three plates of an edge.  What bends by round-off is one plane, and has two feet
// however near to each other.
TEST(Sheets, FeetOnBothRimsOfASlitAreOneOnlyWherePlatesBend) {
  for (const auto& [bend, count] : {std::pair{0.0, 2}, {1e-8, 2}, {1e-7, 2}, {3e-4, 1}, {1e-3, 1}}) {
    const Vector3 low(0, 0, 0), high(0, 0, 1), right(std::cos(bend), std::sin(bend), -20);
    Wall plates;
    plates.add_triangle(low, high, {-1, 0, -20});
    plates.add_triangle(low, right, high);
    plates.add_triangle(low, high, {0.1, -1, 0.5});
    const auto found = feet(built(plates), {1e-4, 1, -0.1}, 1.5);
    const auto on_rim = [](const Foot& foot) { return foot.status == FootStatus::edge; };
    EXPECT_EQ(std::count_if(found.begin(), found.end(), on_rim), count) << bend;
  }
}

TEST(Sheets, TrianglesThatCoverEachOtherCountTwiceUnlessTheyAreOfOneSheet) {
  const Vector3 a(0, 0, 0), b(3, 0, 0), c(3, 3, 0), d(0, 3, 0), over(2.0, 1.0, 0.5);
  Wall plate;
  plate.add_quad(a, b, c, d);
  ASSERT_EQ(feet(built(plate), over, 1.0).size(), 1u);
  Wall other_diagonal = plate, patch = plate, flap = plate;
  other_diagonal.add_quad(b, c, d, a);
  patch.add_triangle({1.5, 0.5, 0}, {2.5, 0.5, 0}, {2.2, 1.5, 0});
  flap.add_triangle(a, c, {2.5, 0.5, 0});  // its free sides join what is above and below
  EXPECT_EQ(feet(built(other_diagonal), over, 1.0).size(), 2u);
  EXPECT_EQ(feet(built(patch), over, 1.0).size(), 2u);
  EXPECT_EQ(feet(built(flap), over, 1.0).size(), 1u);
}

TEST(Sheets, AFootThatLeavesAFaceOfAConcaveEdgeStaysOnTheEdge) {
  // A blunt corner, 150 degrees: to the left of the edge's plane over one face, the other's foot is on the
  // edge.
  const double angle = 150.0 / 180.0 * 3.141592653589793;
  const Surface corner = built(trials::plates({0.0, angle}));
  const auto found = feet(corner, {-0.01, 0.05, 0.5}, 0.2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].status, FootStatus::interior);
  EXPECT_EQ(found[1].status, FootStatus::edge);
  EXPECT_NEAR((found[1].point - Vector3(0.0, 0.0, 0.5)).norm(), 0.0, 1e-14);
  EXPECT_EQ(found[1].patch, 0);
}

TEST(Sheets, AVertexThatIsAFootOnNeitherSideOfABorderIsNoneOnIt) {
  // Plates at the origin, all at right angles.  Seen from beyond the triangle in the plane x = 0 below, the
  // origin would be a foot on the inner side of the upper plate y = 0 where x <= 0, but that is seen from x
  // >= 0 alone.
  const Vector3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  Wall wall;
  for (const auto& [a, b] :
       {std::pair(x, z), std::pair(y, z), std::pair(y, Vector3(-z)), std::pair(x, Vector3(x + y)),
        std::pair(Vector3(-z), Vector3(-x)), std::pair(Vector3(-x), y)})
    wall.add_triangle(o, a, b);
  const Surface plates = built(wall);
  for (const double at : {-1e-6, 0.0, 1e-6})
    for (const Foot& foot : feet(plates, {at, 0.4, -1.0}, 1.2))
      EXPECT_GT(foot.point.norm(), 0.1) << "x = " << at << ", sheet " << foot.sheet;
}

TEST(Builder, LeavesOutWhatHasCollapsedAndReportsIt) {
  Wall wall = trials::cube();
  wall.triangles.push_back({0, 0, 1});
  wall.triangles.push_back(wall.triangles[3]);
  BuildReport report;
  const Surface cube = from_triangles(wall.coordinates(), wall.corners(), 0.02, &report);
  EXPECT_EQ(report.collapsed, 1);
  EXPECT_EQ(report.duplicates, 1);
  EXPECT_EQ(cube.edges.size(), 12u);
}

TEST(Builder, TakesAThinTriangleIntoThePlaneBesideIt) {
  // The square's lower side has a point on it that only the thin triangle has.
  Wall wall;
  wall.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, -1e-9, 1e-9}, {0, -1, 1}, {1, -1, 1}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {0, 5, 4}, {4, 5, 6}, {4, 6, 1}};
  BuildReport report;
  const Surface surface = from_triangles(wall.coordinates(), wall.corners(), 0.02, &report);
  EXPECT_EQ(report.thin, 1);
  EXPECT_EQ(surface.faces.size(), 2u);
  EXPECT_EQ(summary_of(surface).free, 6);
  EXPECT_EQ(feet(surface, {0.3, -0.01, -0.05}, 0.1).size(), 1u);  // on the convex edge, not twice
}

TEST(Builder, RefusesWhatItCannotUse) {
  const Wall cube = trials::cube();
  const auto refused = [&](std::vector<int> corners, NodalVectors points) -> std::string {
    try {
      from_triangles(points, corners);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refused({0, 1, 8}, cube.coordinates()), HasSubstr("point 8 is not among the 8"));
  EXPECT_THAT(refused({0, 1}, cube.coordinates()), HasSubstr("not 3 each"));
  NodalVectors points = cube.coordinates();
  points(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused(cube.corners(), points), HasSubstr("finite"));
}

TEST(Summary, CountsEdgesAndMeasures) {
  const Summary cube = summary_of(built(trials::cube()));
  EXPECT_EQ(cube.faces[0], 6);
  EXPECT_EQ(cube.pieces, 12);
  EXPECT_EQ(cube.convex, 12);
  EXPECT_TRUE(cube.closed);
  EXPECT_NEAR(cube.area, 6.0, 1e-12);
  EXPECT_NEAR(cube.volume, 1.0, 1e-12);
  const Summary profile = summary_of(built(trials::l_profile()));
  EXPECT_EQ(profile.concave, 1);
  EXPECT_NEAR(profile.volume, 3.0, 1e-12);
  const Summary box = summary_of(built(trials::open_box()));
  EXPECT_EQ(box.free, 4);
  EXPECT_FALSE(box.closed);
  EXPECT_NEAR(box.free_length, 4.0, 1e-12);
  EXPECT_EQ(summary_of(built(trials::plates({0.0, 1.0, 2.0}))).many, 1);
}

TEST(Trials, RandomWallsAgreeWithTheJudge) {
  long count = 0;
  for (int index = 0; index < 48; ++index) {
    trials::TriangleTrial trial(7, index);
    ASSERT_EQ(trial.try_sheets(), "") << index;
    for (int k = 0; k < 210; ++k) EXPECT_EQ(trial.try_point(k, count), "") << index << ", point " << k;
  }
  EXPECT_GT(count, 20000);
}

TEST(Trials, WallsThatWereWrittenToStlFilesAgreeWithTheJudge) {
  long count = 0;
  for (int index = 0; index < 48; ++index) {
    const auto trial = trials::stl_trial(1, index);
    ASSERT_EQ(trial->try_sheets(), "") << index;
    for (int k = 0; k < 60; ++k) EXPECT_EQ(trial->try_point(k, count), "") << index << ", point " << k;
  }
  EXPECT_GT(count, 10000);
}

// Exactly over a vertex of a face: the pieces beside see an edge or its end, as round-off has it.
TEST(Trials, ATieOfAnEdgeAndItsVertexLosesNoFoot) {
  trials::TriangleTrial trial(1, 530);
  ASSERT_EQ(trial.try_sheets(), "");
  long count = 0;
  for (int k = 0; k <= 238; ++k) EXPECT_EQ(trial.try_point(k, count), "") << "point " << k;
}

}  // namespace
}  // namespace brep
