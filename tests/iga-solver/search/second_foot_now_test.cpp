// SPDX-License-Identifier: GPL-2.0-or-later
// Where no second foot can be now, against what is promised, and against the radius of a cylinder, which no
// reach exceeds.
#include "search/second_foot.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nurbs/curvature.h"
#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace search {
namespace {

using namespace nurbs;

using shapes::uniform;

struct Tangents {
  Vector3 S, S_i[2];
};
Tangents tangents(const Surface& surface, int element, const Parameter<2>& xi) {
  RationalBasis<2> basis;
  evaluate_on_element(surface.space, element, xi, 1, basis);
  Tangents t{interpolate(basis, surface.control_points), {Vector3::Zero(), Vector3::Zero()}};
  for (int a = 0; a < basis.count; ++a)
    for (int i = 0; i < 2; ++i)
      t.S_i[i] += basis.dR[i][a] * surface.control_points.col(basis.control_point[a]);
  return t;
}

// Parameters of a window; a point in it, on its lower border 0 if asked for.
struct Region {
  double low[2], high[2];
  Region(const Space<2>& space, const ElementWindow& window) {
    for (int i = 0; i < 2; ++i) {
      low[i] = space.knots(i).breaks()[window.begin[i]];
      high[i] = space.knots(i).breaks()[window.end[i]];
    }
  }
  Parameter<2> point(shapes::Random& random, bool on_border = false) const {
    return {on_border ? low[0] : uniform(random, low[0], high[0]), uniform(random, low[1], high[1])};
  }
};

// Where phi falls into no direction of the window: along the normal, or, on the lower border 0, tilted
// outwards.
Vector3 to_point(shapes::Random& random, const Tangents& t, bool on_border) {
  Vector3 n = t.S_i[0].cross(t.S_i[1]).normalized();
  if (uniform(random, -1, 1) < 0.0) n = -n;
  if (!on_border) return n;
  const Vector3 along = t.S_i[1].normalized(), inward = (t.S_i[0] - t.S_i[0].dot(along) * along).normalized();
  const double angle = uniform(random, 0.0, 0.5 * M_PI);
  return std::cos(angle) * n - std::sin(angle) * inward;
}

// Feet in a window of points at half the reach and more, against points of the window.
void expect_nearest(shapes::Random& random, const Surface& surface, const SecondFoot& second_foot, int level,
                    const int (&e)[2]) {
  const double rho = second_foot.excluded_below(level, e);
  const ElementWindow window = second_foot.window(level, e);
  ASSERT_TRUE(window.holds(e));
  const Region region(surface.space, window);
  for (int foot = 0; foot < 10; ++foot) {
    const bool on_border = foot % 3 == 0;
    const Parameter<2> xi = region.point(random, on_border);
    const int element =
        on_border ? surface.space.element_index({window.begin[0], surface.space.knots(1).element_at(xi[1])})
                  : surface.space.element_at(xi);
    const Tangents t = tangents(surface, element, xi);
    const double r = std::min(rho, 10.0) * uniform(random, 0.5, 1.0);
    const Vector3 d = t.S + r * to_point(random, t, on_border);
    for (int sample = 0; sample < 40; ++sample) {
      Parameter<2> other = region.point(random);
      if (sample % 2 == 0)  // near the foot, where there is least to spare
        for (int i = 0; i < 2; ++i) other[i] = xi[i] + 0.1 * (other[i] - xi[i]);
      EXPECT_GE((interpolate(surface.space, surface.control_points, other) - d).norm(), r * (1.0 - 1e-12))
          << "level " << level << ", reach " << rho;
    }
  }
}

TEST(SecondFootNow, NothingInTheWindowIsNearer) {
  shapes::Random random(43);
  int useful[SecondFoot::kLevels] = {0};
  for (int k = 0; k < 300; ++k) {
    const int n = 3 + k % 40;
    const double height = std::pow(10.0, uniform(random, -4.0, -0.5));
    Surface surface = shapes::random_hills(
        random,
        {KnotVector::uniform(2 + k % 4, n),
         k % 5 == 0 ? shapes::random_knots(random, 2 + k % 3, 4) : KnotVector::uniform(2 + k % 3, 16)},
        height, k % 2 == 1);
    const double uneven = k % 3 * 0.25 / n;  // speed of the parameters, too
    for (auto x : surface.control_points.colwise())
      x += Vector3(uniform(random, -uneven, uneven), uniform(random, -uneven, uneven), 0.0);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(uniform(random, 0, 6), Vector3(1, 2, 3).normalized()).toRotationMatrix();
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 1) = uniform(random, -2.0, 2.0);
    surface.control_points = (turn * shear * surface.control_points).eval();
    const SecondFoot second_foot(surface.space, surface.control_points);
    for (int level = 0; level < SecondFoot::kLevels; ++level) {
      const int e[2] = {static_cast<int>(uniform(random, 0, surface.space.knots(0).element_count())),
                        static_cast<int>(uniform(random, 0, surface.space.knots(1).element_count()))};
      const double rho = second_foot.excluded_below(level, e);
      ASSERT_GE(rho, 0.0);
      if (rho == 0.0) continue;
      ++useful[level];
      expect_nearest(random, surface, second_foot, level, e);
    }
  }
  for (int level = 0; level < 4; ++level) EXPECT_GT(useful[level], 10) << "level " << level;
}

// What random surfaces seldom show: parameters that run slowly at one end, and curvature by twist alone.
TEST(SecondFootNow, SlowParametersAndTwist) {
  shapes::Random random(44);
  const KnotVector line(1, {0, 0, 1, 1}), parabola(2, {0, 0, 0, 1, 1, 1});
  Surface slow{Space<2>({parabola, line}), NodalVectors(3, 6)};  // x = u - 0.8 u^2, z = u^2 / 2, |u| < 1/2
  slow.control_points << -0.7, 0.2, 0.3, -0.7, 0.2, 0.3,         //
      0, 0, 0, 0.1, 0.1, 0.1,                                    //
      0.125, -0.125, 0.125, 0.125, -0.125, 0.125;
  Surface twisted{Space<2>({line, line}), NodalVectors(3, 4)};  // z = x y
  twisted.control_points << -0.2, 0.2, -0.2, 0.2,               //
      -0.2, -0.2, 0.2, 0.2,                                     //
      0.04, -0.04, -0.04, 0.04;
  for (const Surface& surface : {slow, twisted}) {
    const SecondFoot second_foot(surface.space, surface.control_points);
    const int e[2] = {0, 0};
    EXPECT_GT(second_foot.excluded_below(0, e), 0.001);
    for (int k = 0; k < 100; ++k) expect_nearest(random, surface, second_foot, 0, e);
  }
}

// A sheet bent at one of its four rims alone: no reach of a window there exceeds the radius of curvature,
// elsewhere nothing bounds it.  Asked of one block after the other, each has its own answer.
TEST(SecondFootNow, OfASheetBentAtOneRim) {
  const Surface sheet =
      plane({0, 0, 0}, {12, 0, 0}, {0, 12, 0}, {KnotVector::uniform(2, 12), KnotVector::uniform(2, 12)});
  const int n = sheet.space.control_point_count(0);
  for (int side = 0; side < 4; ++side) {
    NodalVectors points = sheet.control_points;
    for (Eigen::Index a = 0; a < points.cols(); ++a) {
      const int place = static_cast<int>(side < 2 ? a % n : a / n);
      if (place == (side % 2 == 0 ? 0 : n - 1)) points(2, a) = 0.2;
    }
    const MultiPatch patch({sheet.space});
    const SecondFoot second_foot(sheet.space, points);
    for (int f = 0; f < 12; ++f)
      for (int e = 0; e < 12; ++e) {
        SCOPED_TRACE(testing::Message() << "side " << side << ", element " << e << ", " << f);
        const int at[2] = {e, f}, from_rim = side % 2 == 0 ? at[side / 2] : 11 - at[side / 2];
        const double r = second_foot.excluded_below(0, at);
        if (from_rim > 1) {
          EXPECT_GT(r, 1e12);
          continue;
        }
        Parameter<2> rim{(e + 0.5) / 12.0, (f + 0.5) / 12.0};
        rim[side / 2] = side % 2;
        const SurfaceShape shape = shape_at(patch, points, {0, rim});
        const double curvature = std::max(std::abs(shape.curvature[0]), std::abs(shape.curvature[1]));
        EXPECT_GT(curvature, 0.1);
        EXPECT_LE(r, 1.0 / curvature);
      }
  }
}

// A window ends at creases; one that a crease would cut in its own block is empty.
TEST(SecondFootNow, WindowsEndAtCreases) {
  const KnotVector creased(2, {0, 0, 0, 1, 2, 3, 3, 4, 5, 6, 6, 6}), smooth = KnotVector::uniform(2, 6);
  const Surface plate = plane(Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), {creased, smooth});
  const SecondFoot second_foot(plate.space, plate.control_points);
  const auto range = [&](int level, int e0) {
    const int e[2] = {e0, 0};
    const ElementWindow window = second_foot.window(level, e);
    return std::make_pair(window.begin[0], window.end[0]);
  };
  EXPECT_EQ(range(0, 0), std::make_pair(0, 2));
  EXPECT_EQ(range(0, 1), std::make_pair(0, 3));
  EXPECT_EQ(range(0, 2), std::make_pair(1, 3));
  EXPECT_EQ(range(0, 3), std::make_pair(3, 5));
  EXPECT_EQ(range(1, 1), std::make_pair(0, 3));
  EXPECT_EQ(range(1, 3), std::make_pair(0, 0));  // elements 2 and 3
  EXPECT_EQ(range(1, 5), std::make_pair(3, 6));
  const int cut[2] = {3, 0}, whole[2] = {5, 0};
  EXPECT_EQ(second_foot.excluded_below(1, cut), 0.0);
  EXPECT_GT(second_foot.excluded_below(1, whole), 1e12);
}

// Not above the radius, and not far below on small windows; follows the control points.
TEST(SecondFootNow, RadiusOfACylinder) {
  const double radius = 2.0;
  const Frame axis = frame(Vector3(5, -7, 3), Vector3(1, 2, 2).normalized());
  Surface quarter = cylinder(axis, radius, 1.0, refined(arc(0.0, 90.0), 128, 2), KnotVector::uniform(2, 128));
  SecondFoot second_foot(quarter.space, quarter.control_points);
  for (const int element : {0, 40, 127}) {
    const int e[2] = {element, element};
    double last = radius;
    for (int level = 0; level < SecondFoot::kLevels; ++level) {
      const double rho = second_foot.excluded_below(level, e);
      EXPECT_LE(rho, last);
      last = rho;
    }
    EXPECT_GT(second_foot.excluded_below(0, e), 0.75 * radius);
  }
  quarter.control_points *= 0.25;
  second_foot.surface_moved();
  const int e[2] = {40, 40};
  EXPECT_LE(second_foot.excluded_below(0, e), 0.25 * radius);
  EXPECT_GT(second_foot.excluded_below(0, e), 0.75 * 0.25 * radius);
}

// Weights that are all multiplied by a number are those of the same surface.
TEST(SecondFootNow, IsThatOfTheSurfaceHoweverLargeItsWeights) {
  const Surface quarter = cylinder(frame({0, 0, 0}, {0, 0, 1}), 2.0, 1.0, refined(arc(0.0, 90.0), 16, 2),
                                   KnotVector::uniform(2, 4));
  std::vector<double> weights = quarter.space.weights();
  for (double& w : weights) w *= 5.0;
  const Space<2> heavy({quarter.space.knots(0), quarter.space.knots(1)}, weights);
  const SecondFoot second_foot(quarter.space, quarter.control_points),
      of_heavy(heavy, quarter.control_points);
  const int e[2] = {3, 1};
  for (int level = 0; level < SecondFoot::kLevels; ++level) {
    const double rho = second_foot.excluded_below(level, e);
    EXPECT_NEAR(of_heavy.excluded_below(level, e), rho, 1e-6 * rho) << "level " << level;
  }
}

}  // namespace
}  // namespace search
