// SPDX-License-Identifier: GPL-2.0-or-later
#include "nurbs/patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numeric>

#include "nurbs/primitives.h"
#include "nurbs/shapes.h"

namespace nurbs {
namespace {

using testing::HasSubstr;

double sum(const double* values, int count) { return std::accumulate(values, values + count, 0.0); }
double size(const double* values, int count) {
  return std::accumulate(values, values + count, 0.0, [](double s, double x) { return s + std::abs(x); });
}

template <int Dim>
void expect_partition_of_unity(const Space<Dim>& space, const Parameter<Dim>& xi) {
  const auto basis = std::make_unique<RationalBasis<Dim>>();
  evaluate(space, xi, 2, *basis);
  EXPECT_EQ(basis->count, space.functions_per_element());
  EXPECT_NEAR(sum(basis->R, basis->count), 1.0, 1e-14);
  for (int a = 0; a < basis->count; ++a) EXPECT_GE(basis->R[a], 0.0);
  for (const auto& derivative : basis->dR)
    EXPECT_NEAR(sum(derivative, basis->count), 0.0, 1e-14 * size(derivative, basis->count));
  for (const auto& derivative : basis->d2R)
    EXPECT_NEAR(sum(derivative, basis->count), 0.0, 1e-13 * size(derivative, basis->count));
}

// First derivatives against differences of the values, second ones against differences of the first, on one
// element.
template <int Dim>
void expect_finite_differences(const Space<Dim>& space, int element) {
  const auto at = std::make_unique<RationalBasis<Dim>>(), before = std::make_unique<RationalBasis<Dim>>(),
             after = std::make_unique<RationalBasis<Dim>>();
  const Parameter<Dim> xi = space.element_centre(element);
  const Indices<Dim> indices = space.element_indices(element);
  std::array<double, Dim> length;
  for (int d = 0; d < Dim; ++d)
    length[d] = space.knots(d).breaks()[indices[d] + 1] - space.knots(d).breaks()[indices[d]];

  evaluate_on_element(space, element, xi, 2, *at);
  for (int e = 0; e < Dim; ++e) {
    Parameter<Dim> low = xi, high = xi;
    const double h = 1e-4 * length[e];
    low[e] -= h, high[e] += h;
    evaluate_on_element(space, element, low, 1, *before);
    evaluate_on_element(space, element, high, 1, *after);
    for (int a = 0; a < at->count; ++a) {
      EXPECT_NEAR(at->dR[e][a], (after->R[a] - before->R[a]) / (2 * h), 1e-6 / length[e]);
      int k = 0;  // order (0,0) (0,1) .. (1,1) ..: pairs d <= c
      for (int d = 0; d < Dim; ++d)
        for (int c = d; c < Dim; ++c, ++k)
          if (c == e || d == e) {
            const int other = c == e ? d : c;
            EXPECT_NEAR(at->d2R[k][a], (after->dR[other][a] - before->dR[other][a]) / (2 * h),
                        1e-5 / (length[e] * length[other]));
          }
    }
  }
}

template <int Dim>
void check_random_spaces(unsigned seed) {
  shapes::Random random(seed);
  for (const bool rational : {false, true})
    for (int k = 0; k < 6; ++k) {
      const Patch<Dim> patch = shapes::random_patch<Dim>(random, Dim == 3 ? 4 : 6, 3, rational);
      for (int sample = 0; sample < 20; ++sample)
        expect_partition_of_unity(patch.space, shapes::random_parameter(random, patch.space));
      for (int element = 0; element < patch.space.element_count(); element += 4)
        expect_finite_differences(patch.space, element);
    }
}

TEST(Patch, RandomCurves) { check_random_spaces<1>(1); }
TEST(Patch, RandomSurfaces) { check_random_spaces<2>(2); }
TEST(Patch, RandomVolumes) { check_random_spaces<3>(3); }

// R_A = w_A N_A / sum w N with the one-dimensional functions, at the documented index i + n_xi (j + n_eta k).
TEST(Patch, ControlPointsAreNumberedXiFirst) {
  shapes::Random random(4);
  const Volume volume = shapes::random_patch<3>(random, 3, 3, true);
  const Space<3>& space = volume.space;
  const Parameter<3> xi = shapes::random_parameter(random, space);
  BasisFunctions N[3];
  for (int d = 0; d < 3; ++d) evaluate_basis(space.knots(d), space.knots(d).find_span(xi[d]), xi[d], 0, N[d]);
  Vector3 numerator = Vector3::Zero();
  double denominator = 0.0;
  const int n_xi = space.control_point_count(0), n_eta = space.control_point_count(1);
  for (int k = 0; k <= space.degree(2); ++k)
    for (int j = 0; j <= space.degree(1); ++j)
      for (int i = 0; i <= space.degree(0); ++i) {
        const int A = N[0].first + i + n_xi * (N[1].first + j + n_eta * (N[2].first + k));
        const double wN = space.weights()[A] * N[0].values[0][i] * N[1].values[0][j] * N[2].values[0][k];
        numerator += wN * volume.control_points.col(A);
        denominator += wN;
      }
  EXPECT_NEAR((interpolate(space, volume.control_points, xi) - numerator / denominator).norm(), 0.0, 1e-14);

  RationalBasis<3> basis;
  evaluate(space, xi, 0, basis);
  std::vector<int> of_element(space.functions_per_element());
  space.element_control_points(space.element_at(xi), of_element.data());
  EXPECT_EQ(of_element, std::vector<int>(basis.control_point, basis.control_point + basis.count));
}

TEST(Patch, ElementsAreNumberedXiFirst) {
  const Space<3> space({KnotVector::uniform(1, 3), KnotVector::uniform(2, 4), KnotVector::uniform(2, 5)});
  EXPECT_EQ(space.element_count(), 60);
  EXPECT_EQ(space.element_index({2, 1, 3}), 2 + 3 * (1 + 4 * 3));
  for (int e = 0; e < 60; ++e) {
    EXPECT_EQ(space.element_index(space.element_indices(e)), e);
    EXPECT_EQ(space.element_at(space.element_centre(e)), e);
  }
  EXPECT_EQ(space.element_at({1.0, 1.0, 1.0}), 59);
}

// A kink at a double knot: left and right derivatives are those of the elements, and evaluate() takes the
// right one.
TEST(Patch, OneSidedDerivativesAtAKnot) {
  const Space<1> space({KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 2})});
  const NodalVectors heights =
      (NodalVectors(3, 5) << 0, .5, 1, 1.5, 2, 0, 1, 2, 1, 0, 0, 0, 0, 0, 0).finished();
  const auto slope = [&](const RationalBasis<1>& basis) {
    double s = 0.0;
    for (int a = 0; a < basis.count; ++a) s += basis.dR[0][a] * heights(1, basis.control_point[a]);
    return s;
  };
  RationalBasis<1> basis;
  evaluate_on_element(space, 0, {1.0}, 1, basis);
  EXPECT_DOUBLE_EQ(slope(basis), 2.0);
  evaluate_on_element(space, 1, {1.0}, 1, basis);
  EXPECT_DOUBLE_EQ(slope(basis), -2.0);
  evaluate(space, {1.0}, 1, basis);
  EXPECT_DOUBLE_EQ(slope(basis), -2.0);
}

TEST(Patch, EvaluateClampsToTheDomain) {
  shapes::Random random(5);
  const Curve curve = shapes::random_patch<1>(random, 3, 3, true);
  EXPECT_EQ(interpolate(curve.space, curve.control_points, {-1.0}), curve.control_points.col(0));
  EXPECT_NEAR(
      (interpolate(curve.space, curve.control_points, {1e9}) - curve.control_points.rightCols(1)).norm(), 0.0,
      1e-15);
}

// Quadratic rationals describe a circle exactly: radius, and the known parametrisation of an arc.
TEST(Patch, ExactCircle) {
  const Surface cylinder = shapes::revolve(shapes::line(10.0, 20.0), M_PI / 2, 4);
  for (int k = 0; k <= 400; ++k) {
    const Vector3 point = interpolate(cylinder.space, cylinder.control_points, {0.01 * k, 0.3});
    EXPECT_NEAR(point.head<2>().norm(), 10.0, 5e-15);
    EXPECT_NEAR(point.z(), 6.0, 2e-15);
  }
  for (double angle : {0.0, 0.1, 0.7, 1.2, 1.5}) {
    const double xi = shapes::arc_parameter(angle, M_PI / 2);
    const Vector3 point = interpolate(cylinder.space, cylinder.control_points, {xi, 0.0});
    EXPECT_NEAR(std::atan2(point.y(), point.x()), angle, 1e-15);
  }
}

// Tangents of the cylinder along and across, and the curvature vector S_xi,xi + ... of the circle: the
// component along the radius of S_xixi is -|S_xi|^2 / R for every parametrisation.
TEST(Patch, CircleTangentAndCurvature) {
  const Surface cylinder = shapes::revolve(shapes::line(10.0, 20.0), M_PI / 2);
  RationalBasis<2> basis;
  for (double xi : {0.0, 0.2, 0.55, 1.0}) {
    evaluate(cylinder.space, {xi, 0.4}, 2, basis);
    Vector3 S = Vector3::Zero(), S_xi = S, S_eta = S, S_xixi = S, S_etaeta = S;
    for (int a = 0; a < basis.count; ++a) {
      const Vector3 P = cylinder.control_points.col(basis.control_point[a]);
      S += basis.R[a] * P;
      S_xi += basis.dR[0][a] * P;
      S_eta += basis.dR[1][a] * P;
      S_xixi += basis.d2R[0][a] * P;
      S_etaeta += basis.d2R[2][a] * P;
    }
    const Vector3 radial(S.x() / 10.0, S.y() / 10.0, 0.0);
    EXPECT_NEAR(S_xi.dot(radial), 0.0, 1e-13);
    EXPECT_NEAR(S_xixi.dot(radial), -S_xi.squaredNorm() / 10.0, 1e-12);
    EXPECT_NEAR((S_eta - Vector3(0, 0, 20)).norm(), 0.0, 1e-13);
    EXPECT_NEAR(S_etaeta.norm(), 0.0, 1e-12);
  }
}

TEST(Patch, RefusesBadWeightsAndControlPoints) {
  const KnotVector knots = KnotVector::uniform(2, 1);
  const auto message = [&](std::vector<double> weights) -> std::string {
    try {
      Space<1>({knots}, weights);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({1, 2, 3}), "accepted");
  EXPECT_THAT(message({1, 2}), HasSubstr("2 weights given, expected 3"));
  EXPECT_THAT(message({1, 0, 1}), HasSubstr("weight 2 is 0, expected a number > 0"));
  EXPECT_THAT(message({1, 1, -1}), HasSubstr("weight 3 is -1"));
  EXPECT_THAT(message({1, NAN, 1}), HasSubstr("weight 2 is nan"));

  Curve curve{Space<1>({knots}), NodalVectors::Zero(3, 3)};
  EXPECT_NO_THROW(check_patch(curve));
  curve.control_points(1, 2) = INFINITY;
  EXPECT_THROW(check_patch(curve), std::invalid_argument);
  curve.control_points = NodalVectors::Zero(3, 4);
  EXPECT_THROW(check_patch(curve), std::invalid_argument);
}

// A box and a plane are affine in their parameters, on graded meshes of any degree and domain.
TEST(Primitives, BoxIsAffine) {
  shapes::Random random(6);
  for (int degree = 1; degree <= kMaxVolumeDegree; ++degree) {
    const Vector3 origin(-1, 2, 0.5), size(3, 0.2, 5);
    const Volume volume = box(origin, size,
                              {KnotVector::from_breaks(degree, {0, .1, .4, 1}),
                               KnotVector::uniform(degree, 2, -1, 3), KnotVector::uniform(2, 3)});
    for (int k = 0; k < 20; ++k) {
      const Parameter<3> xi = shapes::random_parameter(random, volume.space);
      const Vector3 t(xi[0], (xi[1] + 1) / 4, xi[2]);
      EXPECT_NEAR(
          (interpolate(volume.space, volume.control_points, xi) - origin - size.cwiseProduct(t)).norm(), 0.0,
          1e-14);
    }
  }
  const KnotVector knots = KnotVector::uniform(1, 1);
  EXPECT_THROW(box({0, 0, 0}, {1, 0, 1}, {knots, knots, knots}), std::invalid_argument);
  EXPECT_THROW(box({0, 0, 0}, {1, -1, 1}, {knots, knots, knots}), std::invalid_argument);
}

TEST(Primitives, PlaneIsAffine) {
  shapes::Random random(7);
  const Vector3 origin(1, 1, 1), edge_u(2, 0, 1), edge_v(0.5, 3, 0);
  const Surface surface =
      plane(origin, edge_u, edge_v, {KnotVector::uniform(3, 4), KnotVector::from_breaks(2, {0, .2, 1})});
  for (int k = 0; k < 20; ++k) {
    const Parameter<2> xi = shapes::random_parameter(random, surface.space);
    EXPECT_NEAR(
        (interpolate(surface.space, surface.control_points, xi) - origin - xi[0] * edge_u - xi[1] * edge_v)
            .norm(),
        0.0, 1e-14);
  }
  const KnotVector knots = KnotVector::uniform(1, 1);
  EXPECT_THROW(plane(origin, edge_u, 2 * edge_u, {knots, knots}), std::invalid_argument);
  EXPECT_THROW(plane(origin, edge_u, {0, 0, 0}, {knots, knots}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbs
