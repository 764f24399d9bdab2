// SPDX-License-Identifier: GPL-2.0-or-later
// A surface has moved: searches look at the control points near their feet alone, where their owner has them.
#include <gtest/gtest.h>

#include <numeric>
#include <type_traits>

#include "nurbs/guarded_columns.h"
#include "nurbs/primitives.h"
#include "search/multi_patch_projector.h"

namespace search {
namespace {

using namespace nurbs;

// Temporaries would be gone when they are looked at.
using Points = NodalVectors;
using Shifted = decltype(std::declval<Points&>().colwise() + Vector3());
static_assert(std::is_constructible_v<SurfaceProjector, const Space<2>&, const Points&>);
static_assert(!std::is_constructible_v<SurfaceProjector, const Space<2>&, Points>);
static_assert(!std::is_constructible_v<SurfaceProjector, const Space<2>&, const Points>);
static_assert(!std::is_constructible_v<SurfaceProjector, const Space<2>&, Shifted>);
static_assert(std::is_constructible_v<MultiPatchProjector, const MultiPatch&, const Points&>);
static_assert(!std::is_constructible_v<MultiPatchProjector, const MultiPatch&, Points>);
static_assert(!std::is_constructible_v<MultiPatchProjector, const MultiPatch&, Shifted>);

/// Two squares side by side, of n x n elements of size 1.
PatchedSurface sheet(int n) {
  const auto knots = KnotVector::uniform(2, n);
  std::vector<Surface> squares;
  for (const double x : {0.0, 1.0 * n})
    squares.push_back(plane({x, 0, 0}, {1.0 * n, 0, 0}, {0, 1.0 * n, 0}, {knots, knots}));
  return join(squares);
}

// Balls roll along the edge y = 0 of the second square while it rises; nothing may ask for what is farther
// off.  With all minima the neighbours of a foot count, too, as far as its window reaches.
TEST(UntouchedPoints, AStepLooksAtThoseNearItsFeet) {
  constexpr int kElements = 128, kRows = 64;
  PatchedSurface surface = sheet(kElements);
  const MultiPatch& topology = surface.topology;
  Points& points = surface.control_points;
  MultiPatchProjector projector(topology, points);
  projector.begin_list();
  std::vector<int> candidates(4);
  std::iota(candidates.begin(), candidates.end(), topology.first_element(1) + 8);
  const Points rising = Vector3(0, 0, 0.01).replicate(1, kRows * (kElements + 2));
  for (int step = 1; step <= 5; ++step) {
    const Eigen::Index first = topology.first_control_point(1);
    points.middleCols(first, rising.cols()) += rising;
    const GuardedColumns guard(points, first + rising.cols());
    ASSERT_GT(guard.pages(), 40);
    projector.surface_moved();
    const Vector3 d(kElements + 10.3 + 0.1 * step, 0.4, 0.5);
    EXPECT_TRUE(projector.excludes_second_foot(d + Vector3(0, 1, 0), 0.6, candidates[2] + kElements));
    std::vector<Foot> feet;
    projector.add_minima(d, Vector3::Zero(), 0.6, 1e-7, candidates.data(), 4, feet);
    ASSERT_EQ(feet.size(), 1U);
    feet.push_back(projector.follow(d, {1, {10.0 / kElements, 1.0 / kElements}}, Vector3::Zero()));
    Foot followed = feet[0], *pointer = &followed;
    projector.follow(&d, &pointer, 1);
    feet.push_back(followed);
    for (const Foot& foot : feet) EXPECT_LE((foot.point - Vector3(d[0], d[1], 0.01 * step)).norm(), 1e-13);
  }
}

TEST(UntouchedPoints, MayBeStoredElsewhere) {
  PatchedSurface surface = sheet(4);
  MultiPatchProjector projector(surface.topology, surface.control_points);
  Points moved = surface.control_points.colwise() + Vector3(0, 0, 0.25);
  surface.control_points.swap(moved);
  moved.setZero();
  projector.surface_moved();
  const Foot foot = projector.follow({5.0, 2.0, 1.0}, {1, {0.5, 0.5}}, Vector3::Zero());
  EXPECT_NEAR(foot.distance, 0.75, 1e-14);
  EXPECT_EQ(projector.patch(1).control_points().data(),
            surface.control_points.data() + 3 * surface.topology.first_control_point(1));
}

TEST(UntouchedPoints, AreAsManyAsThePatchesHave) {
  const PatchedSurface surface = sheet(4);
  const Points few = surface.control_points.leftCols(7);
  EXPECT_THROW(MultiPatchProjector(surface.topology, few), std::invalid_argument);
}

}  // namespace
}  // namespace search
