// SPDX-License-Identifier: GPL-2.0-or-later
// The tailor rolled blank: as a primitive, and as a shape of a geometry file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "geometry_io/geometry_file.h"
#include "nurbs/gauss_legendre.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace geometry_io {
namespace {

using namespace nurbs;

// Thin on the left, a ramp up, thick, another ramp down to a third thickness.
const std::vector<Strip> kStrips = {
    {3.0, {1.0, 1.0}, 2}, {2.0, {1.0, 2.5}, 4}, {4.0, {2.5, 2.5}, 3}, {1.0, {2.5, 2.0}, 2}};
const Vector3 kOrigin(-1, 5, 7);
constexpr double kWidth = 6.0, kLength = 10.0;

// 1 - 2 (1 - s)^2 and 2 s^2: two parabolas that meet in the middle.
double ramp(double s) { return s < 0.5 ? 2.0 * s * s : 1.0 - 2.0 * (1.0 - s) * (1.0 - s); }
double thickness(double x) {
  if (x <= 3.0) return 1.0;
  if (x <= 5.0) return 1.0 + 1.5 * ramp((x - 3.0) / 2.0);
  if (x <= 9.0) return 2.5;
  return 2.5 - 0.5 * ramp(x - 9.0);
}

Volume plate(int degree) {
  return rolled_plate(kOrigin, kWidth, kStrips, degree,
                      {KnotVector::uniform(degree, 3), KnotVector::uniform(2, 1)});
}

TEST(RolledPlate, HasItsThicknessEverywhereForEveryDegree) {
  shapes::Random random(3);
  for (int degree = 2; degree <= kMaxVolumeDegree; ++degree) {
    const Volume volume = plate(degree);
    EXPECT_EQ(volume.space.element_count(), 11 * 3);
    for (int k = 0; k < 500; ++k) {
      const Parameter<3> xi = shapes::random_parameter(random, volume.space);
      const double x = xi[0] * kLength;
      const Vector3 expected = kOrigin + Vector3(x, xi[1] * kWidth, xi[2] * thickness(x));
      const Vector3 point = interpolate(volume.space, volume.control_points, xi);
      EXPECT_LE((point - expected).cwiseAbs().maxCoeff(), 2e-14) << degree << ' ' << x;
    }
  }
}

TEST(RolledPlate, OfDegreeTwoHasOneKnotBetweenElementsSoItIsSmooth) {
  const KnotVector knots = plate(2).space.knots(0);
  EXPECT_EQ(knots.creases().size(), 2u);
  EXPECT_EQ(knots.control_point_count(), 11 + 2);
  for (double expected : {1.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.0 + 4.0 / 3.0, 9.0, 9.5}) {
    const std::vector<double>& breaks = knots.breaks();
    EXPECT_TRUE(std::any_of(breaks.begin(), breaks.end(), [&](double b) {
      return std::abs(b * kLength - expected) < 1e-14;
    })) << expected;
  }
}

TEST(RolledPlate, HasTheVolumeOfItsThickness) {
  const Volume volume = plate(2);
  double sum = 0.0;
  RationalBasis<3> basis;
  for (int e = 0; e < volume.space.element_count(); ++e) {
    QuadratureRule rule[3];
    const Indices<3> span = volume.space.element_indices(e);
    for (int d = 0; d < 3; ++d) {
      const std::vector<double>& breaks = volume.space.knots(d).breaks();
      rule[d] = gauss_legendre(3, breaks[span[d]], breaks[span[d] + 1]);
    }
    for (int q = 0; q < 27; ++q) {
      const int i[3] = {q % 3, q / 3 % 3, q / 9};
      evaluate(volume.space, {rule[0].points[i[0]], rule[1].points[i[1]], rule[2].points[i[2]]}, 1, basis);
      Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
      for (int a = 0; a < basis.count; ++a)
        for (int d = 0; d < 3; ++d)
          J.col(d) += basis.dR[d][a] * volume.control_points.col(basis.control_point[a]);
      sum += J.determinant() * rule[0].weights[i[0]] * rule[1].weights[i[1]] * rule[2].weights[i[2]];
    }
  }
  // A ramp is as thick in the mean as half way.
  EXPECT_NEAR(sum, kWidth * (3.0 * 1.0 + 2.0 * 1.75 + 4.0 * 2.5 + 1.0 * 2.25), 1e-12);
}

const std::string kRolled =
    "units: si\ngeometry:\n"
    "  rolled_plate: {origin: [1, 2, 3], width: 3, elements: [3, 2], degree: 2, strips: [\n"
    "    {length: 1, thickness: 1, elements: 1},\n"
    "    {length: 2, thickness: [1, 2], elements: 4},\n"
    "    {length: 1, thickness: 2, elements: 1}]}\nsurfaces: {top: zeta+}\n";

TEST(RolledPlate, IsReadFromAFile) {
  const GeometryFile file = parse_geometry_file(kRolled, "wall.yaml");
  EXPECT_EQ(std::get<Volume>(file.patches.front()).space.element_indices(35), (Indices<3>{5, 2, 1}));
  const Surface top = named_surface(file, "top", "wall.yaml").front().surface;
  const auto at = [&](double u, double v) { return interpolate(top.space, top.control_points, {u, v}); };
  EXPECT_NEAR((at(0.0, 1.0) - Vector3(1, 5, 4)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((at(0.5, 0.5) - Vector3(3, 3.5, 4.5)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((at(0.75, 0.0) - Vector3(4, 2, 5)).norm(), 0.0, 1e-14);
}

TEST(RolledPlate, SaysWhatIsWrongInItsFile) {
  const struct {
    std::string from, to, message;
  } table[] = {
      {"elements: 4", "elements: 3", "wall.yaml:3: strip 2: 3 elements in a ramp, expected an even number"},
      {"[1, 2]", "[1.5, 2]",
       "wall.yaml:3: strip 2: begins with thickness 1.5, expected 1, where strip 1 ends"},
      {"[1, 2]", "[1, -2]", "wall.yaml:3: strip 2: thickness is -2, expected a number > 0"},
      {"[1, 2]", "[1, 2, 3]", "wall.yaml:5: thickness is a list of 3, expected 2"},
      {"degree: 2", "degree: 1", "wall.yaml:3: degree along x is 1, expected 2 at least"},
      {"length: 2", "length: 0", "length is 0, expected a number > 0"},
      {"[3, 2]", "[3, 2, 1]", "wall.yaml:3: elements is a list of 3, expected 2"},
      {"width: 3", "width: 0", "width is 0, expected a number > 0"},
      {"width: 3, ", "", "geometry.rolled_plate.width is missing"},
      {"length: 2", "lenght: 2", "did you mean 'length'?"},
  };
  for (const auto& [from, to, message] : table) {
    std::string text = kRolled;
    text.replace(text.find(from), from.size(), to);
    EXPECT_THAT([&] { parse_geometry_file(text, "wall.yaml"); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr(message)))
        << to;
  }
}

}  // namespace
}  // namespace geometry_io
