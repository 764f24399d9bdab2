// SPDX-License-Identifier: GPL-2.0-or-later
// Why both horizons are needed: cases where what is proved now says nothing about the next list, and the
// other way round.
#include "search/second_foot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"
#include "search/multi_patch_projector.h"

namespace search {
namespace {

using namespace nurbs;

// A surface at the moment of a new list.
struct Subject {
  PatchedSurface surface;
  MultiPatchProjector projector;
  explicit Subject(const std::vector<Surface>& patches)
      : surface(join(patches)), projector(surface.topology, surface.control_points) {
    projector.begin_list();
  }
  double now(int level, const Parameter<2>& xi, int patch = 0) const {
    const Space<2>& space = surface.topology.patch(patch);
    const int e[2] = {space.knots(0).element_at(xi[0]), space.knots(1).element_at(xi[1])};
    return projector.patch(patch).second_foot().excluded_below(level, e);
  }
  bool ahead(const Vector3& d, double reach, const Parameter<2>& xi) const {
    return projector.excludes_second_foot(d, reach, surface.topology.patch(0).element_at(xi));
  }
  std::vector<Foot> feet(const Vector3& d, double reach) const {
    std::vector<int> elements(surface.topology.element_count());
    for (size_t k = 0; k < elements.size(); ++k) elements[k] = static_cast<int>(k);
    std::vector<Foot> found;
    projector.add_minima(d, Vector3::Zero(), reach, 1e-9, elements.data(), static_cast<int>(elements.size()),
                         found);
    return found;
  }
};

// Two arms a length of 1 apart and a bend between: each arm is flat, and its feet can be followed from list
// to list; but the second one is there already, and the nearer, so that a search for the nearest must not
// leave out the window that holds both.
TEST(SecondFoot, OfASheetFoldedOntoItself) {
  constexpr double kArm = 5.0, kBend = 0.5 * M_PI, kLength = 2.0 * kArm + kBend;
  Surface sheet =
      plane({0, 0, 0}, {1, 0, 0}, {0, 4, 0}, {KnotVector::uniform(2, 24), KnotVector::uniform(2, 8)});
  const std::vector<double> u = sheet.space.knots(0).greville();
  for (Eigen::Index a = 0; a < sheet.control_points.cols(); ++a) {
    const double s = kLength * u[a % u.size()], angle = std::clamp((s - kArm) / 0.5, 0.0, M_PI);
    const double along = s < kArm ? s : s > kArm + kBend ? kLength - s : kArm;
    sheet.control_points(0, a) = along + 0.5 * std::sin(angle);
    sheet.control_points(2, a) = 0.5 * (1.0 - std::cos(angle));
  }
  const Subject subject({sheet});
  const Vector3 d(1.5, 2.0, 0.6);
  const std::vector<Foot> feet = subject.feet(d, 0.7);
  ASSERT_EQ(feet.size(), 2u);
  EXPECT_NEAR(feet[0].distance, 0.4, 1e-12);
  EXPECT_NEAR(feet[1].distance, 0.6, 1e-12);
  for (const Foot& foot : feet) {
    EXPECT_TRUE(subject.ahead(d, 0.7, foot.xi));
    EXPECT_GT(subject.now(0, foot.xi), 1e6) << "of an arm";
    EXPECT_LT(subject.now(SecondFoot::kLevels - 1, foot.xi), 0.5) << "of all";
  }
  EXPECT_NEAR(subject.projector.patch(0).nearest(d, feet[1].xi).distance, 0.4, 1e-12);
}

// Beyond a weld the proof knows nothing: of a flat patch it excludes a second foot at any distance.
TEST(SecondFoot, OfAKinkBetweenPatches) {
  const std::array<KnotVector, 2> knots = {KnotVector::uniform(2, 4), KnotVector::uniform(2, 4)};
  const Subject corner(
      {plane({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, knots), plane({4, 0, 0}, {0, 0, 4}, {0, 4, 0}, knots)});
  const Vector3 d(3.3, 1.5, 0.5);
  EXPECT_EQ(corner.feet(d, 0.9).size(), 2u);
  EXPECT_GT(corner.now(0, {0.8, 0.4}), 1e6);
  EXPECT_FALSE(corner.ahead(d, 0.9, {0.8, 0.4}));
  EXPECT_TRUE(corner.ahead(d, 0.8, {0.8, 0.4}));  // 0.86 from the kink
}

// Of an exact arc of 90 degrees in one element nothing is proved; its curvature is known all the same.
TEST(SecondFoot, OfAnArcInOneElement) {
  const Subject quarter(
      {cylinder(frame({0, 0, 0}, {0, 0, 1}), 3.0, 40.0, arc(0, 90), KnotVector::uniform(2, 1))});
  const Vector3 d = 2.0 * Vector3(1, 1, 0).normalized() + Vector3(0, 0, 20);
  EXPECT_EQ(quarter.now(0, {0.5, 0.5}), 0.0);
  EXPECT_TRUE(quarter.ahead(d, 1.4, {0.5, 0.5}));
  EXPECT_FALSE(quarter.ahead(d, 1.6, {0.5, 0.5}));
}

// A rod: inside there is its radius, outside nothing ever happens; the proof is one of both sides.
TEST(SecondFoot, OfARod) {
  const Subject rod({cylinder(frame({0, 0, 0}, {0, 0, 1}), 0.5, 4.0, refined(arc(0, 180), 64, 2),
                              KnotVector::uniform(2, 400))});
  const Vector3 out(0, 1, 0), middle(0, 0, 2);
  EXPECT_LT(rod.now(0, {0.5, 0.5}), 0.5);
  EXPECT_GT(rod.now(0, {0.5, 0.5}), 0.3);
  EXPECT_TRUE(rod.ahead(middle + 2.0 * out, 1.9, {0.51, 0.5}));
  // Half the radius, where so much is proved as well.
  EXPECT_TRUE(rod.ahead(middle + 0.3 * out, 0.24, {0.51, 0.5}));
  EXPECT_FALSE(rod.ahead(middle + 0.3 * out, 0.26, {0.51, 0.5}));
}

// Where so much is proved that curvatures need not be sampled, these would have said the same.
TEST(SecondFoot, IsNeverProvedAgainstTheCurvature) {
  shapes::Random random(45);
  int proved = 0;
  for (int k = 0; k < 60; ++k) {
    const Surface hills =
        shapes::random_hills(random, {KnotVector::uniform(2 + k % 3, 6), KnotVector::uniform(2 + k % 2, 6)},
                             std::pow(10.0, shapes::uniform(random, -3.0, -0.5)), k % 2 == 1);
    const Subject subject({hills});
    for (int sample = 0; sample < 50; ++sample) {
      const Parameter<2> xi{shapes::uniform(random, 0.0, 1.0), shapes::uniform(random, 0.0, 1.0)};
      const double reach = subject.now(0, xi);
      if (reach == 0.0) continue;
      ++proved;
      const SurfaceShape shape = shape_at(subject.surface.topology, subject.surface.control_points, {0, xi});
      const double curvature = std::max(std::abs(shape.curvature[0]), std::abs(shape.curvature[1]));
      EXPECT_LE(reach * curvature, 1.0);
    }
  }
  EXPECT_GT(proved, 500);
}

}  // namespace
}  // namespace search
