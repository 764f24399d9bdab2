// SPDX-License-Identifier: GPL-2.0-or-later
// Patches that turn inside, and edges in which many meet: feet against the judge of triangles, who knows
// nothing of patches; forces and energy of a ball that is pressed on them.
#include "brep/patch_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "brep/faced_patches.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "roller.h"
#include "trials.h"

namespace brep {
namespace {

using nurbs::KnotVector;
using trials::uniform;
using trials::whole;

/// Points of a grid, rows along the first direction.
struct Net {
  int n, m;
  std::vector<Vector3> points;
  const Vector3& at(int i, int j) const { return points[i + n * j]; }
};

/// A facetted patch: of degree 1, or of a higher one that has the same C0 knots.
nurbs::Surface facetted(const Net& net, int elevations = 0) {
  nurbs::Surface patch{nurbs::Space<2>({KnotVector::uniform(1, net.n - 1, 2.0, 5.0),
                                        KnotVector::uniform(1, net.m - 1, -1.0, 0.5)}),
                       nurbs::NodalVectors(3, net.n * net.m)};
  for (int k = 0; k < net.n * net.m; ++k) patch.control_points.col(k) = net.points[k];
  for (int i = 0; i < 2; ++i) patch = nurbs::elevate_degree(patch, i, elevations);
  return patch;
}

trials::Wall triangles_of(const std::vector<Net>& nets) {
  trials::Wall wall;
  for (const Net& net : nets)
    for (int j = 0; j + 1 < net.m; ++j)
      for (int i = 0; i + 1 < net.n; ++i)
        wall.add_quad(net.at(i, j), net.at(i + 1, j), net.at(i + 1, j + 1), net.at(i, j + 1));
  return wall;
}

/// Cells that are plane: a polygon that is shifted, or widened about the origin, from level to level.
Net folded(std::mt19937& random, bool tapers, bool closed) {
  const int n = closed ? whole(random, 4, 6) : whole(random, 3, 6), m = whole(random, 2, 4);
  Net net{n, m, {}};
  std::vector<Vector3> profile;
  for (int i = 0; i < n; ++i) {
    const double angle = (closed ? 2.0 * nurbs::kPi : 4.0) * i / (n - 1);
    const double r = uniform(random, 0.5, 1.0);
    profile.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
  }
  if (closed) profile.back() = profile.front();
  double scale = 1.0;
  Vector3 shift = Vector3::Zero();
  for (int j = 0; j < m; ++j) {
    for (const Vector3& x : profile) net.points.push_back(scale * x + shift);
    scale *= tapers ? uniform(random, 0.6, 1.4) : 1.0;
    shift += Vector3(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), uniform(random, 0.3, 0.8));
  }
  return net;
}

void expect_feet_of_triangles(const std::vector<Net>& nets, std::mt19937& random, bool in_closed_form,
                              int points = 600) {
  std::vector<nurbs::Surface> patches;
  for (const Net& net : nets) patches.push_back(facetted(net, whole(random, 0, in_closed_form ? 0 : 1)));
  const auto faced = faced_patches(patches, false, kEdgeAngle);
  ASSERT_TRUE(faced);
  EXPECT_EQ(!faced->charts.empty(), in_closed_form);
  trials::TriangleTrial trial(triangles_of(nets), faced->surface, random);
  ASSERT_EQ(trial.try_sheets(), "");
  long feet = 0;
  for (int k = 0; k < points; ++k) ASSERT_EQ(trial.try_point(k, feet), "") << "point " << k;
  EXPECT_GT(feet, points / 4);
}

TEST(PatchParts, FoldedPatchesHaveTheFeetOfTriangles) {
  std::mt19937 random(1);
  for (int k = 0; k < 24; ++k)
    expect_feet_of_triangles({folded(random, k % 2 == 0, k % 4 >= 2)}, random, false);
}

// Right-angled prisms: planes in closed form.
TEST(PatchParts, FoldedStripsHaveTheFeetOfTriangles) {
  std::mt19937 random(2);
  for (int k = 0; k < 12; ++k) {
    Net strip = folded(random, false, k % 2 == 0);
    strip.m = 2;
    strip.points.resize(2 * strip.n);
    for (int i = 0; i < strip.n; ++i) strip.points[i + strip.n] = strip.points[i] + 0.8 * Vector3::UnitZ();
    expect_feet_of_triangles({strip}, random, true);
  }
}

/// Plates that meet in the z axis, their outer ends moved so that no plate is a rectangle.
std::vector<Net> star(std::mt19937& random, const std::vector<double>& degrees, bool skewed) {
  std::vector<Net> nets;
  for (const double angle : degrees) {
    const double a = angle * nurbs::kPi / 180.0;
    const Vector3 out(std::cos(a), std::sin(a), 0.0), top(0.0, 0.0, 1.0);
    const double low = skewed ? uniform(random, -0.3, 0.3) : 0.0,
                 high = skewed ? uniform(random, 0.8, 1.3) : 1.0;
    Net net{2, 2, {Vector3::Zero(), out + low * top, top, out + high * top}};
    switch (whole(random, 0, 3)) {  // where it begins, and how it is turned
      case 1:
        net.points = {net.points[1], net.points[0], net.points[3], net.points[2]};
        break;
      case 2:
        net.points = {net.points[2], net.points[0], net.points[3], net.points[1]};
        break;
      case 3:
        net.points = {net.points[3], net.points[2], net.points[1], net.points[0]};
        break;
      default:
        break;
    }
    nets.push_back(net);
  }
  return nets;
}

TEST(PatchParts, EdgesOfManyPatchesHaveTheFeetOfTriangles) {
  std::mt19937 random(3);
  for (const bool skewed : {false, true})
    for (int k = 0; k < 4; ++k) {
      expect_feet_of_triangles(star(random, {0, 180, 90}, skewed), random, !skewed);       // T
      expect_feet_of_triangles(star(random, {0, 90, 180, 270}, skewed), random, !skewed);  // X
      expect_feet_of_triangles(star(random, {10, 140, 250}, skewed), random, !skewed);     // Y
      expect_feet_of_triangles(star(random, {0, 40, 75, 200, 310}, skewed), random, !skewed);
    }
}

// A fin stands where a sheet is folded, and where one goes on straight.
TEST(PatchParts, AFinOnAFoldOfOnePatchHasTheFeetOfTriangles) {
  std::mt19937 random(4);
  for (const double rise : {-0.4, 0.3}) {
    const Net sheet{3, 2, {{-1, 0, 0}, {0, 0, 0}, {1, 0, rise}, {-1, 1, 0}, {0, 1, 0}, {1, 1.2, rise}}};
    const Net fin{2, 2, {{0, 0, 0}, {0, 1, 0}, {0.1, 0.1, 0.8}, {0.1, 1.1, 0.8}}};
    expect_feet_of_triangles({sheet, fin}, random, false);
  }
}

TEST(PatchParts, AreNamedByTheParametersOfThePatch) {
  std::mt19937 random(5);
  const Net net = folded(random, true, false);
  const nurbs::Surface patch = facetted(net, 1);
  const PatchParts parts({patch, patch}, kEdgeAngle);
  const std::vector<nurbs::Surface> all = parts.parts_of({patch, patch});
  ASSERT_EQ(static_cast<int>(all.size()), 2 * (net.n - 1) * (net.m - 1));
  for (int p = 0; p < static_cast<int>(all.size()); ++p) {
    EXPECT_EQ(parts.patch_of(p), 2 * p / static_cast<int>(all.size()));
    const nurbs::Space<2>& space = all[p].space;
    for (const double s : {0.0, 0.3, 1.0})
      for (const double t : {0.0, 0.8, 1.0}) {
        nurbs::Parameter<2> xi;
        const double share[2] = {s, t};
        for (int i = 0; i < 2; ++i)
          xi[i] = (1.0 - share[i]) * space.knots(i).front() + share[i] * space.knots(i).back();
        const Vector3 on_part = nurbs::interpolate(space, all[p].control_points, xi);
        EXPECT_LT((on_part - nurbs::interpolate(patch.space, patch.control_points, xi)).norm(), 1e-15);
        nurbs::Parameter<2> kept = xi;
        parts.keep_in(p, kept);
        EXPECT_EQ(parts.part_at({parts.patch_of(p), kept}), p);
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(kept[i], xi[i], 1e-15);
      }
  }
}

/// A fold along y that is sharp at y = 0 and fades to none at y = 1, beside a plane that goes on there.
std::vector<nurbs::Surface> fading_fold(double rise) {
  const Net sheet{3, 2, {{-1, 0, 0}, {0, 0, 0}, {1, 0, rise}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}};
  const Net plane{2, 2, {{1, 1, 0}, {1, 2, 0}, {-1, 1, 0}, {-1, 2, 0}}};
  return {facetted(sheet), facetted(plane)};
}

TEST(PatchParts, ACutGoesOnThroughPatchesBeyondASide) {
  const std::vector<nurbs::Surface> patches = fading_fold(0.5);
  const PatchParts parts(patches, kEdgeAngle);
  const std::vector<nurbs::Surface> all = parts.parts_of(patches);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(parts.patch_of(3), 1);
  EXPECT_TRUE(all[3].control_points.col(0).isApprox(Vector3(0, 1, 0)));
  EXPECT_EQ(parts.part_at({1, {3.0, -0.26}}), 2);
  EXPECT_EQ(parts.part_at({1, {3.0, -0.24}}), 3);
}

TEST(PatchParts, AreOfPatchesThatTurnBySomethingAlone) {
  const Net flat{3, 2, {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0.3, 1, 0}, {1, 1, 0}}};
  EXPECT_FALSE(faced_patches({facetted(flat, 1)}, false, kEdgeAngle));
  Net bent = flat;
  bent.points[2][2] = bent.points[5][2] = 0.011;
  EXPECT_FALSE(faced_patches({facetted(bent, 1)}, false, kEdgeAngle)) << "below edge_angle";
  EXPECT_TRUE(faced_patches({facetted(bent, 1)}, false, 0.01));
  bent.points[0] = bent.points[3] = bent.points[1];
  bent.points[4] = bent.points[1];
  EXPECT_FALSE(faced_patches({facetted(bent, 1)}, false, 0.001)) << "a cell without an area";
}

// A jump of the force by F in one of `steps` steps of a way L would be a slope of F * steps / L.
TEST(PatchParts, OverKinksForceIsContinuousAndEnergyKept) {
  constexpr double kRadius = 0.1, kPressed = 0.95 * kRadius;
  for (const double rise : {-0.5, -0.1, 0.1, 0.5}) {
    for (const double side : {1.0, -1.0}) {
      const FacedPatches faced = *faced_patches(fading_fold(rise), false, kEdgeAngle);
      trials::Roller roller(faced.surface, kRadius);
      const auto way = roller.along({-0.2, 0.3, side * kPressed}, {0.08, 0.5, side * kPressed}, 20000);
      EXPECT_LT(way.slope, 20.0) << rise;
      EXPECT_LT(way.energy_lost, 1e-7) << rise;
      EXPECT_EQ(way.most, rise * side < 0.0 ? 1 : 2) << rise;
    }
  }
}

// A valley at one end of a line, a ridge at the other, of bilinear cells.
TEST(PatchParts, OverAKinkThatChangesItsSignForceIsContinuous) {
  const Net net{3, 2, {{-1, 0, 0.4}, {0, 0, 0}, {1, 0, 0.4}, {-1, 2, -0.4}, {0, 2, 0}, {1, 2, -0.4}}};
  constexpr double kRadius = 0.1;
  const FacedPatches faced = *faced_patches({facetted(net)}, false, kEdgeAngle);
  trials::Roller roller(faced.surface, kRadius);
  for (const double y : {0.2, 0.5, 1.4, 1.7})
    for (const double side : {1.0, -1.0}) {
      const auto way = roller.along({-0.04, y, side * 0.095}, {0.03, y + 0.1, side * 0.095}, 20000);
      EXPECT_LT(way.slope, 30.0) << y;
      EXPECT_LT(way.energy_lost, 1e-7) << y;
      EXPECT_EQ(way.most, (y < 1.0) == (side > 0.0) ? 2 : 1) << y;
    }
}

}  // namespace
}  // namespace brep
