// SPDX-License-Identifier: GPL-2.0-or-later
// The quick values of the functions, and their slopes, are those of the Cox-de Boor recursion.
#include "nurbs/surface_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nurbs/shapes.h"

namespace nurbs {
namespace {

void expect_slopes(const Space<2>& space, const Parameter<2>& xi) {
  RationalBasis<2> basis;
  evaluate(space, xi, 1, basis);
  SurfaceSlopes slopes;
  evaluate_slopes(space, xi, slopes);
  const Vector3 F(1.3, -0.2, 7.1);
  const Tangents G = (Tangents() << 0.3, -2.0, 1.1, 0.4, -0.6, 0.9).finished();
  NodalVectors f = NodalVectors::Constant(3, space.control_point_count(), 0.5), expected = f;
  distribute(slopes, F, G, f);
  double largest = 0.0;
  for (int a = 0; a < basis.count; ++a) {
    expected.col(basis.control_point[a]) +=
        basis.R[a] * F + basis.dR[0][a] * G.col(0) + basis.dR[1][a] * G.col(1);
    largest = std::max({largest, std::abs(basis.dR[0][a]), std::abs(basis.dR[1][a])});
  }
  EXPECT_LE((f - expected).norm(), 1e-12 * (1.0 + largest));
  const NodalVectors X = NodalVectors::Random(3, space.control_point_count());
  Tangents S = Tangents::Zero();
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 2; ++d) S.col(d) += basis.dR[d][a] * X.col(basis.control_point[a]);
  EXPECT_LE((interpolate_slopes(slopes, X) - S).norm(), 1e-12 * (1.0 + largest));
}

TEST(SurfaceValues, AreThoseOfTheRecursion) {
  shapes::Random random(31);
  for (int k = 0; k < 100; ++k) {
    const Surface surface = shapes::random_patch<2>(random, 6, 4, k % 2 == 1);
    const KnotVector &u = surface.space.knots(0), &v = surface.space.knots(1);
    const auto anywhere = [&](const KnotVector& knots) {
      return shapes::uniform(random, knots.front(), knots.back());
    };
    for (const Parameter<2>& xi : {Parameter<2>{anywhere(u), anywhere(v)},
                                   {anywhere(u), anywhere(v)},
                                   {u.front(), v.back()},
                                   {u.back(), v.front()},
                                   {u.breaks()[1], anywhere(v)},
                                   {u.front() - 1.0, v.back() + 1.0}}) {
      RationalBasis<2> basis;
      evaluate(surface.space, xi, 0, basis);
      SurfaceValues values;
      evaluate_values(surface.space, xi, values);

      ASSERT_EQ((values.p + 1) * (values.q + 1), basis.count);
      for (int j = 0, a = 0; j <= values.q; ++j)
        for (int i = 0; i <= values.p; ++i, ++a) {
          EXPECT_EQ(values.first + i + values.stride * j, basis.control_point[a]);
          EXPECT_NEAR(values.R[a], basis.R[a], 1e-13);
        }
      const Vector3 S = interpolate<2>(basis, surface.control_points);
      EXPECT_NEAR((interpolate(values, surface.control_points) - S).norm(), 0.0, 1e-12);

      const Vector3 F(1.3, -0.2, 7.1);
      NodalVectors f = NodalVectors::Constant(3, surface.space.control_point_count(), 0.5), expected = f;
      distribute(values, F, f);
      for (int a = 0; a < basis.count; ++a) expected.col(basis.control_point[a]) += basis.R[a] * F;
      EXPECT_LE((f - expected).norm(), 1e-12);
      expect_slopes(surface.space, xi);
    }
  }
}

// The degrees that are compiled apart, on which most contacts are.
TEST(SurfaceValues, OfDegreesTwoAndThree) {
  shapes::Random random(32);
  for (const int p : {2, 3})
    for (const bool rational : {false, true}) {
      const KnotVector knots = KnotVector::from_breaks(p, {0.0, 0.3, 1.0});
      std::vector<double> weights;
      for (int a = 0; rational && a < (p + 2) * (p + 2); ++a)
        weights.push_back(shapes::uniform(random, 0.5, 2.0));
      const Space<2> space({knots, knots}, weights);
      for (int k = 0; k < 50; ++k) {
        const Parameter<2> xi = {shapes::uniform(random, 0.0, 1.0), shapes::uniform(random, 0.0, 1.0)};
        RationalBasis<2> basis;
        evaluate(space, xi, 0, basis);
        SurfaceValues values;
        evaluate_values(space, xi, values);
        for (int a = 0; a < basis.count; ++a) EXPECT_NEAR(values.R[a], basis.R[a], 1e-14);
        expect_slopes(space, xi);
      }
    }
}

}  // namespace
}  // namespace nurbs
