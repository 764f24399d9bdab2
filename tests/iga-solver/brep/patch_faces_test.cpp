// SPDX-License-Identifier: GPL-2.0-or-later
// All minima of the distance on a patch, found downhill where that is enough, against branch and bound over
// the whole patch.
#include "brep/patch_faces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>

#include "brep/builder.h"
#include "brep/faced_patches.h"
#include "brep/foot_search.h"
#include "nurbs/borders.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"

namespace brep {
namespace {

nurbs::Surface part_of_torus(double ring_angle, double tube_from, double tube_to, int degree) {
  const nurbs::Frame at = nurbs::frame({0.3, -0.2, 0.1}, {0.2, 0.5, 1.0});
  return nurbs::torus(
      at, 3.0, 1.0, nurbs::arc(0.0, ring_angle),
      nurbs::refined(nurbs::arc(tube_from, tube_to), tube_to - tube_from > 90.0 ? 4 : 1, degree));
}

// Turned by so much in elements so large and bent that where it closes, or nearly does, all of them are near.
nurbs::Surface trumpet(double angle) {
  const nurbs::Frame at = nurbs::frame({0.3, -0.2, 0.1}, {0.2, 0.5, 1.0});
  return nurbs::torus(at, 4.88, 3.88, nurbs::arc(0.0, angle), nurbs::arc(96.0, 182.0));
}

// A sheet of which one half lies over the other.
nurbs::Surface hairpin() {
  constexpr int kDegree = 4, kArm = 10;
  std::vector<double> along(kDegree, 0.0), across(kDegree + 1, 0.0);
  constexpr int kCount = 2 * kArm + 3;
  for (int k = 0; k <= kCount - kDegree; ++k) along.push_back(k);
  along.insert(along.end(), kDegree, kCount - kDegree);
  across.insert(across.end(), kDegree + 1, 1.0);
  nurbs::NodalVectors points(3, kCount * (kDegree + 1));
  for (int j = 0; j <= kDegree; ++j)
    for (int k = 0; k < kCount; ++k) {
      const int from_bend = std::abs(k - kArm - 1);
      const double height = from_bend == 0 ? 0.5 : k > kArm ? 1.0 : 0.0;
      points.col(k + kCount * j) = Vector3(0.5 * (kArm - from_bend), 0.75 * j, height);
    }
  return {nurbs::Space<2>({nurbs::KnotVector(kDegree, along), nurbs::KnotVector(kDegree, across)}, {}),
          points};
}

// Two windings, 0.8 apart.
nurbs::Surface scroll() {
  constexpr int kDegree = 2, kElements = 24, kCount = kElements + kDegree;
  const nurbs::KnotVector along = nurbs::KnotVector::uniform(kDegree, kElements),
                          across = nurbs::KnotVector::uniform(1, 1);
  nurbs::NodalVectors points(3, 2 * kCount);
  for (int k = 0; k < kCount; ++k) {
    const double turn = 2.0 * k / (kCount - 1), r = 1.5 + 0.8 * turn, angle = nurbs::kTwoPi * turn;
    for (int j = 0; j < 2; ++j)
      points.col(k + kCount * j) = Vector3(r * std::cos(angle), r * std::sin(angle), 2.0 * j);
  }
  return {nurbs::Space<2>({along, across}, {}), points};
}

struct PatchCase {
  std::string name;
  nurbs::Surface patch;
};

class MinimaOnPatch : public testing::TestWithParam<int> {
 public:
  static PatchCase given(int number) {
    switch (number) {
      case 0:
        return {"fillet", part_of_torus(90.0, 100.0, 170.0, 14)};
      case 1:
        return {"closed along the ring", part_of_torus(360.0, 100.0, 170.0, 14)};
      case 2:
        return {"closed both ways", part_of_torus(360.0, 0.0, 360.0, 5)};
      default:
        return {"hairpin", hairpin()};
    }
  }
};

TEST_P(MinimaOnPatch, AreThoseOfBranchAndBound) {
  const PatchCase at = given(GetParam());
  const PatchFaces faces({at.patch}, 0.02);
  const nurbs::Space<2>& space = faces.patch(0).space;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<int> elements;
  std::vector<search::Foot> found, all;
  int feet = 0, none = 0;
  for (int k = 0; k < 4000; ++k) {
    Parameter<2> xi;
    for (int i = 0; i < 2; ++i) {
      const nurbs::KnotVector& knots = space.knots(i);
      xi[i] = knots.front() + uniform(random) * (knots.back() - knots.front());
    }
    const Vector3 off(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
    const Vector3 d = faces.point(0, xi) + 1.5 * off;
    const double reach = 0.6 * uniform(random);
    elements.clear();
    for (int e = 0; e < space.element_count(); ++e)
      if (faces.may_have_foot(0, e, d, reach, 0)) elements.push_back(e);
    found.clear();
    if (!elements.empty()) faces.minima_on(0, elements, d, reach, found);
    faces.projector(0).all_minima(d, reach, all);
    const auto counts = [&](const search::Foot& foot) {
      return !faces.on_border(0, foot.xi) && foot.distance < (1.0 - 1e-9) * reach;
    };
    for (const search::Foot& foot : all) {
      if (!counts(foot)) continue;
      ++feet;
      EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                              [&](const search::Foot& f) { return (f.point - foot.point).norm() <= 1e-7; }))
          << at.name << " " << k << ": missed a foot at " << foot.distance << " of " << reach;
    }
    for (const search::Foot& foot : found)
      EXPECT_TRUE(!counts(foot) ||
                  std::any_of(all.begin(), all.end(),
                              [&](const search::Foot& f) { return (f.point - foot.point).norm() <= 1e-7; }))
          << at.name << " " << k << ": a foot that is none at " << foot.distance << " of " << reach;
    none += static_cast<int>(std::none_of(all.begin(), all.end(), counts));
  }
  EXPECT_GT(feet, 500) << at.name;
  EXPECT_GT(none, 500) << at.name;
}

INSTANTIATE_TEST_SUITE_P(Patches, MinimaOnPatch, testing::Range(0, 4));

class WhereAPatchCloses : public testing::TestWithParam<double> {};

// A foot beyond the border at which going downhill ends.
TEST_P(WhereAPatchCloses, NoFootIsLost) {
  const PatchFaces faces({trumpet(GetParam())}, 0.02);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<search::Foot> found;
  int together = 0;
  for (int k = 0; k < 1000; ++k) {
    const double from_border = 0.03 * (2.0 * uniform(random) - 1.0);
    const Parameter<2> below{from_border < 0.0 ? 1.0 + from_border : from_border,
                             0.7 + 0.2 * uniform(random)};
    const double distance = 0.3 + 0.2 * uniform(random), reach = distance + 0.05;
    const Vector3 d = faces.point(0, below) - distance * faces.normal(0, below);
    std::vector<int> elements;
    for (int e = 0; e < 4; ++e)
      if (faces.may_have_foot(0, e, d, reach, 0)) elements.push_back(e);
    together += static_cast<int>(elements.size() == 4);
    faces.minima_on(0, elements, d, reach, found);
    EXPECT_TRUE(std::any_of(
        found.begin(), found.end(),
        [&](const search::Foot& foot) { return (foot.point - faces.point(0, below)).norm() <= 1e-7; }))
        << "missed the foot at " << below[0] << ", " << below[1];
  }
  EXPECT_GT(together, 100);
}

INSTANTIATE_TEST_SUITE_P(Angles, WhereAPatchCloses, testing::Values(360.0, 358.0));

// Between two windings of a rolled sheet: what is said of a foot of one must hold while d comes to the other.
TEST(PointsInAScroll, AreNotWellInsideIfTheyComeToASecondFoot) {
  const std::vector<nurbs::Surface> patches{scroll()};
  const Surface wall = from_cad(model_of(patches, nurbs::find_borders(patches)), {0}, 0.02);
  const FootSearch search(wall);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<int> near;
  std::vector<Foot> feet;
  int inside = 0;
  for (int k = 0; k < 3000; ++k) {
    const Parameter<2> xi{uniform(random), uniform(random)};
    const double touch = 0.2 + 0.5 * uniform(random), margin = 0.2 * touch;
    const Vector3 d =
        wall.patches->point(0, xi) + touch * (2.0 * uniform(random) - 1.0) * wall.patches->normal(0, xi);
    near.clear();
    search.near(d, touch + margin, near);
    const int count = static_cast<int>(near.size());
    if (!search.is_well_inside(near.data(), count, d, touch + margin, margin)) continue;
    ++inside;
    for (int way = 0; way < 10; ++way) {
      const Vector3 off(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
      feet.clear();
      search.feet(d + 0.99 * margin * off.normalized(), touch, near.data(), count, feet);
      EXPECT_LE(feet.size(), 1u) << k;
    }
  }
  EXPECT_GT(inside, 500);
}

}  // namespace
}  // namespace brep
