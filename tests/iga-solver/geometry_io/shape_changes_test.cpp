// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/shape_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry_io/geometry_file.h"
#include "geometry_io/shape_limits.h"

namespace geometry_io {
namespace {

using namespace nurbs;

const std::string kQuarterCylinder =
    "  patches:\n    - degrees: [2, 1]\n      knots: [[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]\n      "
    "control_points: [[1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 2], [1, 1, 2], [0, 1, 2]]\n      weights: [1, "
    "0.7071067811865476, 1, 1, 0.7071067811865476, 1]\n";

Surface surface(const std::string& changes) {
  const std::string text = "units: si\ngeometry:\n" + changes + kQuarterCylinder;
  return std::get<Surface>(parse_geometry_file(text, "wall.yaml").patches.front());
}

// A quarter cylinder, whose round shape must survive.
TEST(ShapeChanges, RefinedTheShapeStays) {
  const Surface plain = surface("");
  const Surface fine = surface("  refine: {degree: [3, 2], divide: [2, 3], knots: [[0.25, 0.25], [0.9]]}\n");
  EXPECT_EQ(fine.space.knots(0).knots(), (std::vector<double>{0, 0, 0, 0, 0.25, 0.25, 0.5, 1, 1, 1, 1}));
  const std::vector<double>& eta = fine.space.knots(1).knots();
  ASSERT_EQ(eta.size(), 9u);
  EXPECT_DOUBLE_EQ(eta[3], 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(eta[4], 2.0 / 3.0);
  EXPECT_EQ(eta[5], 0.9);
  for (const double xi : {0.0, 0.1, 0.37, 1.0})
    for (const double eta : {0.0, 0.45, 0.95}) {
      const Vector3 there = interpolate(fine.space, fine.control_points, {xi, eta});
      EXPECT_NEAR((there - interpolate(plain.space, plain.control_points, {xi, eta})).norm(), 0.0, 1e-15);
      EXPECT_NEAR(there.head<2>().norm(), 1.0, 1e-15);
    }
}

// Scaled, then turned, then moved: (1, 0, 0) -> (2, 0, 0) -> about (2, 1, 0) by 90 degrees -> (3, 1, 0) ->
// (3, 1, 5).
TEST(ShapeChanges, ScaledThenTurnedThenMoved) {
  const Surface changed = surface(
      "  move: [0, 0, 5]\n"
      "  rotate: {origin: [2, 1, 0], axis: [0, 0, 3], angle: 90}\n"
      "  scale: [2, 1, 3]\n");
  EXPECT_NEAR((changed.control_points.col(0) - Vector3(3, 1, 5)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((changed.control_points.col(5) - Vector3(2, -1, 11)).norm(), 0.0, 1e-15);  // (0, 1, 2)
}

struct BadChange {
  const char *line, *message;
};

// Control points come with degrees, too.
TEST(ShapeChanges, AHigherDegreeAsksForRoom) {
  const geometry_io::ShapeLimits limits = geometry_io::shape_limits();
  const auto read = [](const char* degree) {
    parse_geometry_file(
        std::string("units: si\ngeometry:\n  refine: {degree: ") + degree +
            "}\n  box: {origin: [0, 0, 0], size: [1, 1, 1], elements: [4, 3, 2], degree: 1}\n",
        "wall.yaml");
  };
  geometry_io::shape_limits().control_points = 315;  // 9 x 7 x 5
  EXPECT_NO_THROW(read("2"));
  EXPECT_THAT([&] { read("[2, 3, 2]"); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  "degree: elements are 4 x 3 x 2, about 450 control points, expected at most 315")));
  geometry_io::shape_limits() = limits;
}

TEST(ShapeChanges, SaysWhatWasGivenAndWhatWasExpected) {
  const std::string box =
      "  box: {origin: [0, 0, -1], size: [2, 3, 1], elements: [4, 3, 2], degree: [2, 3, 1]}\n";
  for (const BadChange& bad : std::initializer_list<BadChange>{
           {"scale: -1", "scale is -1, expected a number > 0"},
           {"scale: [1, 0, 1]", "scale is [1, 0, 1], expected numbers > 0"},
           {"rotate: {axis: [0, 0, 0], angle: 1}", "axis is [0, 0, 0], expected a direction"},
           {"rotate: {axes: [0, 0, 1], angle: 1}", "did you mean 'axis'"},
           {"refine: {degree: 2}", "degree is 2 in direction 2, expected at least the 3 that the patch has"},
           {"refine: {divide: [2, 2]}", "divide is a list of 2, expected 3"},
           {"refine: {divide: 500000}", "divide: 2000000 elements in direction 1, expected at most 1000000"},
           {"refine: {divide: 200000}", "divide: elements"},
           {"refine: {knots: [[1.5], [], []]}", "knots of direction 1: "},
           {"refin: {divide: 2}", "did you mean 'refine'"},
       })
    EXPECT_THAT(
        [&] {
          parse_geometry_file("units: si\ngeometry:\n  " + std::string(bad.line) + "\n" + box, "wall.yaml");
        },
        testing::ThrowsMessage<InputError>(
            testing::AllOf(testing::StartsWith("wall.yaml:3: "), testing::HasSubstr(bad.message))))
        << bad.line;
}

}  // namespace
}  // namespace geometry_io
