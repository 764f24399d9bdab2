// SPDX-License-Identifier: GPL-2.0-or-later
// The judge against theory: a box, a cylinder and a sphere.
#include "occt_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <random>

#include "write_files.h"

namespace {

using namespace step_parts;

constexpr double kTolerance = 1e-9;  // mm, on parts of 100 mm

OcctJudge judge_of(const std::string& file) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string folder = testing::TempDir() + "occt_judge_" + test;  // tests run at the same time
  std::filesystem::create_directories(folder);
  for (const Part& part : closed_form_parts()) {
    if (part.file == file) write(part, folder);
  }
  return OcctJudge(folder + "/" + file);
}

/// Distance from the inside (negative) or the outside of a convex body that is `gaps` away from its sides in
/// each of two or three directions at right angles.
double signed_distance(std::vector<double> gaps) {
  const double inside = *std::max_element(gaps.begin(), gaps.end());
  if (inside < 0.0) return inside;
  double square = 0.0;
  for (double gap : gaps) square += std::pow(std::max(gap, 0.0), 2);
  return std::sqrt(square);
}

double from_box(const Point& p) {
  return signed_distance({std::abs(p[0]) - 50.0, std::abs(p[1]) - 30.0, std::abs(p[2]) - 20.0});
}
double from_cylinder(const Point& p) {
  return signed_distance({std::hypot(p[0], p[1]) - 30.0, std::abs(p[2] - 40.0) - 40.0});
}
double from_sphere(const Point& p) { return std::hypot(p[0], p[1], p[2]) - 40.0; }

void compare(const std::string& file, const std::function<double(const Point&)>& theory) {
  const OcctJudge judge = judge_of(file);
  ASSERT_EQ(judge.solid_count(), 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-90.0, 90.0);
  for (int i = 0; i < 300; ++i) {
    const Point p{coordinate(random), coordinate(random), coordinate(random)};
    const double distance = theory(p);
    const Nearest nearest = judge.nearest(p);
    EXPECT_NEAR(nearest.distance, std::abs(distance), kTolerance);
    EXPECT_NEAR(theory(nearest.point), 0.0, kTolerance);
    EXPECT_EQ(judge.in_solid(0, p, 1e-7), distance < 0.0 ? Place::kIn : Place::kOut);
    EXPECT_EQ(judge.in_solid(0, nearest.point, 1e-7), Place::kOn);
  }
}

TEST(OcctJudge, Box) { compare("box.step", from_box); }
TEST(OcctJudge, Cylinder) { compare("cylinder.step", from_cylinder); }
TEST(OcctJudge, Sphere) { compare("sphere.step", from_sphere); }

/// Parameters in the faces of the cylinder are those whose points lie on its skin.
TEST(OcctJudge, ParametersInFaces) {
  const OcctJudge judge = judge_of("cylinder.step");
  ASSERT_EQ(judge.face_count(), 3);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  int inside = 0;
  for (int i = 0; i < 300; ++i) {
    const int face = i % 3;
    const Window w = judge.window(face);
    const double u = w.u[0] + share(random) * (w.u[1] - w.u[0]),
                 v = w.v[0] + share(random) * (w.v[1] - w.v[0]);
    const bool in = std::abs(from_cylinder(judge.value(face, u, v))) < kTolerance;
    EXPECT_EQ(judge.in_face_by_polygon(face, u, v), in ? Place::kIn : Place::kOut);
    const bool another_period = w.u[1] - w.u[0] < 7.0 && (u < w.u[0] || u > w.u[1]);
    if (!another_period) {
      EXPECT_EQ(judge.in_face(face, u, v, 1e-9), in ? Place::kIn : Place::kOut);
    }
    inside += in;
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 250);
}

TEST(OcctJudge, VolumesAndAreas) {
  const OcctJudge box = judge_of("box.step"), sphere = judge_of("sphere.step");
  EXPECT_NEAR(box.volume(0), 240000.0, 1e-6);
  EXPECT_NEAR(sphere.volume(0), 4.0 / 3.0 * M_PI * 64000.0, 1e-5);
  EXPECT_NEAR(sphere.area(0), 4.0 * M_PI * 1600.0, 1e-6);
}

TEST(OcctJudge, NoShapeIsAnError) { EXPECT_THROW(OcctJudge("missing.step"), std::runtime_error); }

}  // namespace
