// SPDX-License-Identifier: GPL-2.0-or-later
// Patches that meet in sharp edges: feet as on triangles, where they are flat, and as on each patch by
// itself.
#include "brep/faced_patches.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "brep/builder.h"
#include "brep/foot_search.h"
#include "mixed_trial.h"
#include "nurbs/primitives.h"
#include "search/surface_projector.h"
#include "trial_walls.h"

namespace brep {
namespace {

using nurbs::KnotVector;
using trials::uniform;

/// A flat quad a b c d as a patch that is in no closed form: its points are moved within its plane, but for
/// those of its borders.  `way`: where it begins, and which of its directions comes first.
nurbs::Surface skewed(const std::array<Vector3, 4>& corners, int way, std::mt19937& random) {
  const Vector3 &a = corners[way % 4], &b = corners[(way + 1) % 4], &d = corners[(way + 3) % 4];
  const KnotVector knots = KnotVector::uniform(2, 3);
  nurbs::Surface patch =
      way < 4 ? nurbs::plane(a, b - a, d - a, {knots, knots}) : nurbs::plane(a, d - a, b - a, {knots, knots});
  const int n = knots.control_point_count();
  for (int j = 1; j + 1 < n; ++j)
    for (int i = 1; i + 1 < n; ++i)
      patch.control_points.col(i + n * j) +=
          uniform(random, -0.06, 0.06) * (b - a) + uniform(random, -0.06, 0.06) * (d - a);
  return patch;
}

using Quads = std::vector<std::array<Vector3, 4>>;

Quads cube_of_quads() {
  const auto at = [](int k) { return Vector3(k & 1, k >> 1 & 1, k >> 2 & 1); };
  Quads quads;
  for (const auto& q :
       {std::array<int, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    quads.push_back({at(q[0]), at(q[1]), at(q[2]), at(q[3])});
  return quads;
}

/// Two plates of width 1 that meet in the y axis; the second rises by an angle.
Quads bent_plates(double degrees) {
  const double bend = degrees * nurbs::kPi / 180.0;
  const Vector3 end(std::cos(bend), 0.0, std::sin(bend)), y = Vector3::UnitY();
  return {{{-Vector3::UnitX(), Vector3::Zero(), y, y - Vector3::UnitX()}},
          {{Vector3::Zero(), end, end + y, y}}};
}

void expect_feet_of_triangles(const Quads& quads, std::mt19937& random) {
  trials::Wall wall;
  std::vector<nurbs::Surface> patches;
  for (const auto& q : quads) {
    wall.add_quad(q[0], q[1], q[2], q[3]);
    patches.push_back(skewed(q, static_cast<int>(random() % 8), random));
  }
  const brep::Surface triangles = built(wall);
  const auto faced = faced_patches(patches, false, kEdgeAngle);
  ASSERT_TRUE(faced);
  EXPECT_TRUE(faced->charts.empty());
  EXPECT_EQ(faced->surface.sheet_count, triangles.sheet_count);
  constexpr double kReach = 0.6;
  for (int k = 0; k < 2000; ++k) {
    const Vector3 d = trials::random_point(random, wall, k % 3);
    auto found = trials::feet(faced->surface, d, kReach), expected = trials::feet(triangles, d, kReach);
    ASSERT_EQ(found.size(), expected.size()) << d.transpose();
    const auto by_place = [](const Foot& a, const Foot& b) {
      return std::make_pair(a.distance, a.point.sum()) < std::make_pair(b.distance, b.point.sum());
    };
    for (auto* feet : {&found, &expected}) {
      for (Foot& foot : *feet) foot.distance = 1e-8 * std::round(1e8 * foot.distance);
      std::sort(feet->begin(), feet->end(), by_place);
    }
    for (size_t i = 0; i < found.size(); ++i)
      EXPECT_LT((found[i].point - expected[i].point).norm(), 1e-9) << d.transpose();
  }
}

TEST(FacedPatches, HaveTheFeetOfTheSameWallOfTriangles) {
  std::mt19937 random(7);
  for (int repeat = 0; repeat < 4; ++repeat) {
    expect_feet_of_triangles(cube_of_quads(), random);
    for (const double degrees : {-30.0, -5.0, 5.0, 30.0, 90.0})
      expect_feet_of_triangles(bent_plates(degrees), random);
  }
}

/// Along z, a cup: an elliptic wall of one closed patch, and a bottom that is one point in its middle.
std::vector<nurbs::Surface> cup() {
  const nurbs::Frame at = nurbs::frame(Vector3::Zero(), Vector3::UnitZ());
  const KnotVector along = KnotVector::uniform(2, 3);
  std::vector<nurbs::Surface> patches{nurbs::cylinder(at, 1.0, 1.5, nurbs::arc(0.0, 360.0), along),
                                      nurbs::cone(at, {0.0, 1.0}, 1.0, nurbs::arc(0.0, 360.0), along)};
  for (nurbs::Surface& patch : patches) patch.control_points.row(0) *= 1.3;
  patches[1].control_points.row(2).setZero();
  return patches;
}

// Inside each of the two is a sheet of its own, so the nearest point of each is a foot.
TEST(FacedPatches, OfACupHaveTheNearestPointOfEachPatchInside) {
  const std::vector<nurbs::Surface> patches = cup();
  const auto faced = faced_patches(patches, false, kEdgeAngle);
  ASSERT_TRUE(faced);
  EXPECT_TRUE(faced->charts.empty());
  std::mt19937 random(3);
  constexpr double kReach = 0.8;
  for (int k = 0; k < 1000; ++k) {
    const double angle = uniform(random, 0.0, 2.0 * nurbs::kPi), r = uniform(random, 0.3, 0.98);
    const Vector3 d(1.3 * r * std::cos(angle), r * std::sin(angle), uniform(random, 0.01, 1.0));
    const auto found = trials::feet(faced->surface, d, kReach);
    for (size_t p = 0; p < patches.size(); ++p) {
      const search::SurfaceProjector projector(
          patches[p].space,
          search::PatchPoints(patches[p].control_points, 0, patches[p].space.control_point_count()));
      const search::Foot nearest = projector.cold(d);
      if (nearest.distance > 0.999 * kReach) continue;
      EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                              [&](const Foot& foot) {
                                return foot.patch == static_cast<int>(p) &&
                                       std::abs(foot.distance - nearest.distance) < 1e-9;
                              }))
          << d.transpose() << ", patch " << p;
    }
  }
}

TEST(FacedPatches, AreThoseThatTurn) {
  std::mt19937 random(1);
  const auto patches_of = [&](const Quads& quads) {
    std::vector<nurbs::Surface> patches;
    for (const auto& q : quads) patches.push_back(skewed(q, 0, random));
    return patches;
  };
  EXPECT_FALSE(faced_patches(patches_of(bent_plates(0.0)), false, kEdgeAngle));
  EXPECT_FALSE(faced_patches(patches_of(bent_plates(0.5)), false, kEdgeAngle)) << "below edge_angle";
  EXPECT_TRUE(faced_patches(patches_of(bent_plates(0.5)), false, 0.001));
  EXPECT_FALSE(faced_patches(patches_of({bent_plates(0.0)[0]}), false, kEdgeAngle)) << "alone";

  Quads fin = bent_plates(30.0);
  fin.push_back({Vector3::Zero(), -Vector3::UnitZ(), Vector3(0, 1, -1), Vector3::UnitY()});
  EXPECT_TRUE(faced_patches(patches_of(fin), false, kEdgeAngle)) << "three in one edge";
  Quads standing = bent_plates(0.0);
  standing.push_back(fin.back());
  EXPECT_TRUE(faced_patches(patches_of(standing), false, kEdgeAngle)) << "two of which are smooth";

  std::vector<nurbs::Surface> kinked = patches_of(bent_plates(30.0));
  const KnotVector one = KnotVector::uniform(1, 1), two = KnotVector::uniform(1, 2);
  kinked[0] = nurbs::plane({-1, 0, 0}, Vector3::UnitX(), Vector3::UnitY(), {two, one});
  kinked[1] = nurbs::plane({0, 0, 0}, {0.5, 0, 0.5}, Vector3::UnitY(), {one, one});
  EXPECT_TRUE(faced_patches(kinked, false, kEdgeAngle));
  kinked[0].control_points(2, 1) = kinked[0].control_points(2, 4) = 0.2;
  EXPECT_TRUE(faced_patches(kinked, false, kEdgeAngle)) << "a kink inside";
}

// Rectangles given by control points meet in sharp edges as planes.
TEST(FacedPatches, AreInClosedFormWhereAllHaveOne) {
  const KnotVector knots = KnotVector::uniform(2, 3);
  std::vector<nurbs::Surface> patches{
      nurbs::plane({-1, 0, 0}, Vector3::UnitX(), Vector3::UnitY(), {knots, knots}),
      nurbs::plane({0, 0, 0}, Vector3::UnitZ(), Vector3::UnitY(), {knots, knots})};
  const auto faced = faced_patches(patches, false, kEdgeAngle);
  ASSERT_TRUE(faced);
  EXPECT_EQ(faced->charts.size(), 2u);
  EXPECT_EQ(faced->surface.faces[0].kind, Kind::plane);
}

}  // namespace
}  // namespace brep
