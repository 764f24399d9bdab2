// SPDX-License-Identifier: GPL-2.0-or-later
// Walls of trimmed faces, as CAD files have them, and of patches: the feet of the judges.
#include <gmock/gmock.h>

#include <cmath>

#include "cad_of_wall.h"
#include "mixed_trial.h"

namespace brep::trials {
namespace {

constexpr int kPoints = 60;

class CadFaces : public testing::TestWithParam<Given> {
 protected:
  static void expect_feet(Trial& trial, const std::string& name) {
    long feet = 0;
    EXPECT_EQ(trial.try_sheets(), "") << name;
    for (int k = 0; k < kPoints; ++k) EXPECT_EQ(trial.try_point(k, feet), "") << name << " " << k;
    EXPECT_GT(feet, 0) << name;
  }
};

TEST_P(CadFaces, OfTrianglesHaveTheJudgesFeet) {
  for (int index = 0; index < 2 * kFamilies; ++index) {
    TriangleTrial trial(3, index, GetParam());
    expect_feet(trial, family_name(index % kFamilies));
  }
}

// Faces of another sheet, which met where feet are, made one of two feet of this sheet give way.
TEST_P(CadFaces, OfTrianglesOfSeveralSheetsHaveTheJudgesFeet) {
  for (const auto& [seed, index] : {std::pair{3u, 7}, {16u, 10}, {21u, 82}, {22u, 34}}) {
    TriangleTrial trial(seed, index, GetParam());
    long feet = 0;
    EXPECT_EQ(trial.try_sheets(), "");
    for (int k = 0; k < 170; ++k) EXPECT_EQ(trial.try_point(k, feet), "") << seed << " " << k;
  }
}

TEST_P(CadFaces, InClosedFormHaveTheJudgesFeet) {
  for (int index = 0; index < kMixedFamilies; ++index) {
    MixedTrial trial(5, index, GetParam());
    expect_feet(trial, mixed_family_name(index));
  }
}

// Over the edge of three plates, square above one of them whose sheet falls on beyond a slightly concave
// edge.
TEST_P(CadFaces, SquareAboveAnEdgeOfThreeTheLowerPlateAlone) {
  constexpr double kBend = 1e-3, kHeight = 0.3;
  for (const bool turned : {false, true}) {  // the plate begins the wedge, or ends it
    const double second = nurbs::kPi - kBend;
    const Wall wall = plates({0.0, second, 4.5});
    const Surface surface = given_as(GetParam(), built(wall));
    const double along = turned ? second : 0.0, up = along + (turned ? -0.5 : 0.5) * nurbs::kPi;
    const Vector3 d(kHeight * std::cos(up), kHeight * std::sin(up), 0.5);
    const std::vector<Foot> found = feet(surface, d, 2.0 * kHeight);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].status, FootStatus::interior);
    EXPECT_NEAR(found[0].distance, kHeight * std::cos(kBend), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Given, CadFaces, testing::Values(Given::as_cad, Given::as_patches),
                         [](const auto& of) { return of.param == Given::as_cad ? "AsCad" : "AsPatches"; });

}  // namespace
}  // namespace brep::trials
