// SPDX-License-Identifier: GPL-2.0-or-later
// What fewer points than full quadrature keep: zero modes, constant strain, frequencies, the stable step.
#include "structure/solid/quadrature.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "nurbs/refinement.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using structure::Matrix3;
using structure::Quadrature;
using structure::Solid;

constexpr Quadrature kQuadratures[] = {Quadrature::full, Quadrature::reduced, Quadrature::zou};

std::vector<std::size_t> points(const nurbs::KnotVector& knots, Quadrature quadrature) {
  std::vector<std::size_t> counts;
  for (const nurbs::QuadratureRule& rule : structure::rules_of(knots, quadrature))
    counts.push_back(rule.points.size());
  return counts;
}

TEST(Quadrature, HasMorePointsAtEndsAndBesideRoughLines) {
  using testing::ElementsAre;
  const nurbs::KnotVector quadratic(2, {0, 0, 0, 1, 2, 3, 3, 4, 5, 6, 6, 6}),
      cubic = nurbs::KnotVector::uniform(3, 4);
  EXPECT_THAT(points(quadratic, Quadrature::full), ElementsAre(3, 3, 3, 3, 3, 3));
  EXPECT_THAT(points(quadratic, Quadrature::reduced), ElementsAre(2, 2, 2, 2, 2, 2));
  EXPECT_THAT(points(quadratic, Quadrature::zou), ElementsAre(2, 1, 2, 2, 1, 2));
  const nurbs::KnotVector bezier(2, {0, 0, 0, 1, 1, 2, 2, 2});
  EXPECT_THAT(points(bezier, Quadrature::reduced), ElementsAre(3, 3)) << "spans that are alone";
  EXPECT_THAT(points(bezier, Quadrature::zou), ElementsAre(3, 3));
  EXPECT_THAT(points(cubic, Quadrature::zou), ElementsAre(3, 2, 2, 3));
  EXPECT_THROW(points(nurbs::KnotVector::uniform(4, 4), Quadrature::zou), std::invalid_argument);
  EXPECT_THROW(structure::quadrature_from_name("gauss"), std::invalid_argument);
  for (const Quadrature quadrature : kQuadratures)
    EXPECT_EQ(structure::quadrature_from_name(name(quadrature)), quadrature);
}

Solid solid(const nurbs::Volume& patch, Quadrature quadrature) {
  return {patch, models::elastic(), {quadrature, structure::IntegrationMethod::automatic}};
}

/// With all knots inside of multiplicity p in one direction.
nurbs::Volume with_C0_lines(nurbs::Volume patch, int direction) {
  const nurbs::KnotVector knots = patch.space.knots(direction);
  for (int e = 1; e < knots.element_count(); ++e)
    patch = nurbs::insert_knot(patch, direction, knots.breaks()[e], knots.degree() - 1);
  return patch;
}

void expect_six_zero_modes_and_the_stable_step(const nurbs::Volume& patch) {
  double full_step = 0.0;
  for (const Quadrature quadrature : kQuadratures) {
    SCOPED_TRACE(testing::Message() << name(quadrature) << ", degree " << patch.space.degree(0));
    const Eigen::MatrixXd A = models::mass_scaled_stiffness(solid(patch, quadrature), {});
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
    const double largest = eigenvalues[eigenvalues.size() - 1], step = 2.0 / std::sqrt(largest);
    EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-12 * largest);
    EXPECT_GT(eigenvalues[6], 1e-5 * largest);
    if (quadrature == Quadrature::full) full_step = step;
    EXPECT_NEAR(step, full_step, 0.03 * full_step);
  }
}

TEST(Quadrature, LeavesSixZeroModesAloneAndTheStableStep) {
  for (const int degree : {2, 3}) {
    expect_six_zero_modes_and_the_stable_step(
        models::distorted(models::block({3, 4, 3}, {3, 4, 3}, degree), 0.03));
    expect_six_zero_modes_and_the_stable_step(models::block({4, 1, 1}, {4, 1, 1}, degree));
    expect_six_zero_modes_and_the_stable_step(
        with_C0_lines(with_C0_lines(models::block({3, 2, 2}, {3, 2, 2}, degree), 1), 2));
  }
}

/// Largest force at interior nodes under u = H X, relative to the largest at the boundary.
double patch_test_residual(const nurbs::Volume& patch, Quadrature quadrature) {
  const Solid body = solid(patch, quadrature);
  NodalVectors f(3, body.node_count());
  body.internal_force(models::linear_field(models::some_gradient(), patch.control_points), f);
  return f(Eigen::all, models::interior_nodes(patch.space)).cwiseAbs().maxCoeff() / f.cwiseAbs().maxCoeff();
}

/// A hexahedron whose corners were moved, of higher degree and with more elements: the same map.
nurbs::Volume trilinear(int degree, int elements) {
  nurbs::Volume patch = models::distorted(models::block({1, 1, 1}, {1, 1, 1}, 1), 0.2);
  std::vector<double> inner;
  for (int i = 1; i < elements; ++i) inner.push_back(static_cast<double>(i) / elements);
  for (int d = 0; d < 3; ++d) {
    for (int p = 1; p < degree; ++p) patch = nurbs::elevate_degree(patch, d);
    patch = nurbs::insert_knots(patch, d, inner);
  }
  return patch;
}

/// Unequal spans, and turned and sheared.
nurbs::Volume affine(int degree) {
  nurbs::Volume patch = models::block({1, 2, 3}, {3, 3, 3}, degree);
  for (int d = 0; d < 3; ++d) patch = nurbs::insert_knots(patch, d, {0.1 * patch.space.knots(d).back()});
  patch.control_points = (Matrix3::Identity() + 0.5 * models::some_gradient()) * patch.control_points;
  return patch;
}

TEST(Quadrature, KeepsConstantStrainWhereTheRuleIsExact) {
  for (const int degree : {2, 3}) {
    for (const Quadrature quadrature : kQuadratures)
      EXPECT_LT(patch_test_residual(affine(degree), quadrature), 1e-12);
    for (const Quadrature quadrature : {Quadrature::full, Quadrature::reduced})
      EXPECT_LT(patch_test_residual(trilinear(degree, 4), quadrature), 1e-12);
    EXPECT_GT(patch_test_residual(trilinear(degree, 4), Quadrature::zou), degree == 2 ? 1e-8 : 0.0);
  }
}

/// Lowest axial frequency of a rod that is fixed at one end (Poisson's ratio 0), exact: pi/2 c / L.
double frequency_error(int degree, int elements, Quadrature quadrature) {
  const nurbs::Volume patch = models::block({1, 0.2, 0.2}, {elements, 1, 1}, degree);
  const Solid rod(patch, models::elastic(1.0, 0.0, 1.0),
                  {quadrature, structure::IntegrationMethod::automatic});
  const int n = patch.space.control_point_count(0), nodes = patch.space.control_point_count();
  Eigen::MatrixXd tied = Eigen::MatrixXd::Zero(3 * nodes, n - 1);  // cross-sections move as one
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(n - 1);
  for (int A = 0; A < nodes; ++A)
    if (A % n > 0) {
      tied(3 * A, A % n - 1) = 1.0;
      mass[A % n - 1] += rod.row_sum_mass()[A];
    }
  const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd A =
      scale.asDiagonal() * (tied.transpose() * models::stiffness(rod) * tied) * scale.asDiagonal();
  return std::sqrt(
             Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues()[0]) /
             std::asin(1.0) -
         1.0;
}

// Lumped masses are second order for every degree; the rules do not spoil it.
TEST(Quadrature, KeepsTheOrderOfFrequencies) {
  for (const int degree : {2, 3})
    for (const Quadrature quadrature : kQuadratures) {
      const double coarse = frequency_error(degree, 8, quadrature),
                   fine = frequency_error(degree, 16, quadrature);
      EXPECT_LT(std::abs(fine), 2e-3) << name(quadrature);
      EXPECT_GT(std::log2(std::abs(coarse / fine)), 1.8) << name(quadrature) << ", degree " << degree;
    }
}

// On a curved map constant strain is kept up to quadrature: energy of a stretched quarter ring.
TEST(Quadrature, ConvergesOnCurvedMaps) {
  const auto energy = [](int degree, int elements, Quadrature quadrature) {
    const nurbs::Volume ring = models::quarter_ring(degree, elements);
    return solid(ring, quadrature)
        .strain_energy(models::linear_field(models::some_gradient(), ring.control_points));
  };
  for (const int degree : {2, 3}) {
    const double exact = energy(3, 24, Quadrature::full);
    for (const Quadrature quadrature : {Quadrature::reduced, Quadrature::zou}) {
      const double coarse = energy(degree, 8, quadrature) / exact - 1.0,
                   fine = energy(degree, 16, quadrature) / exact - 1.0;
      EXPECT_LT(std::abs(fine), 2e-4) << name(quadrature) << ", degree " << degree;
      EXPECT_GT(std::log2(std::abs(coarse / fine)), quadrature == Quadrature::zou && degree == 2 ? 1.8 : 3.5)
          << name(quadrature) << ", degree " << degree;
    }
  }
}

}  // namespace
