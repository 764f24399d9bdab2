// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "models.h"
#include "nurbs/gauss_legendre.h"
#include "nurbs/refinement.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using structure::Matrix3;
using structure::Solid;

const double kPi = std::acos(-1.0);

/// Internal force as the literature writes it, f = sum B^T D B u w |J| with Voigt's B (Gao & Feng 2019, eqs.
/// 16-19), element by element on the public basis functions: shares no line with the kernel.
NodalVectors voigt_internal_force(const nurbs::Volume& patch, double E, double nu, const NodalVectors& u) {
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  D.topLeftCorner<3, 3>().setConstant(nu);
  D.diagonal() << 1 - nu, 1 - nu, 1 - nu, 0.5 - nu, 0.5 - nu, 0.5 - nu;
  D *= E / ((1 + nu) * (1 - 2 * nu));
  NodalVectors f = NodalVectors::Zero(3, u.cols());
  const auto rule_at = [&](int direction, int element) {
    const auto& breaks = patch.space.knots(direction).breaks();
    const int span = patch.space.element_indices(element)[direction];
    return nurbs::gauss_legendre(patch.space.degree(direction) + 1, breaks[span], breaks[span + 1]);
  };
  nurbs::RationalBasis<3> basis;
  for (int e = 0; e < patch.space.element_count(); ++e) {
    const auto rx = rule_at(0, e), ry = rule_at(1, e), rz = rule_at(2, e);
    for (std::size_t i = 0; i < rx.points.size(); ++i)
      for (std::size_t j = 0; j < ry.points.size(); ++j)
        for (std::size_t k = 0; k < rz.points.size(); ++k) {
          nurbs::evaluate(patch.space, {rx.points[i], ry.points[j], rz.points[k]}, 1, basis);
          Eigen::MatrixXd dR(basis.count, 3), X(3, basis.count), B(6, 3 * basis.count);
          Eigen::VectorXd u_e(3 * basis.count);
          for (int a = 0; a < basis.count; ++a) {
            dR.row(a) << basis.dR[0][a], basis.dR[1][a], basis.dR[2][a];
            X.col(a) = patch.control_points.col(basis.control_point[a]);
            u_e.segment<3>(3 * a) = u.col(basis.control_point[a]);
          }
          const Matrix3 J = X * dR;
          const Eigen::MatrixXd g = dR * J.inverse();
          for (int a = 0; a < basis.count; ++a)
            B.middleCols<3>(3 * a) << g(a, 0), 0, 0, 0, g(a, 1), 0, 0, 0, g(a, 2), g(a, 1), g(a, 0), 0, 0,
                g(a, 2), g(a, 1), g(a, 2), 0, g(a, 0);
          const Eigen::VectorXd f_e = B.transpose() * (D * (B * u_e)) *
                                      (J.determinant() * rx.weights[i] * ry.weights[j] * rz.weights[k]);
          for (int a = 0; a < basis.count; ++a) f.col(basis.control_point[a]) += f_e.segment<3>(3 * a);
        }
  }
  return f;
}

void expect_equals_voigt(const nurbs::Volume& patch) {
  const Solid solid(patch, models::elastic(3.0, 0.25));
  const NodalVectors u = models::random_vectors(solid.node_count(), 3);
  NodalVectors f(3, solid.node_count());
  solid.internal_force(u, f);
  const NodalVectors expected = voigt_internal_force(patch, 3.0, 0.25, u);
  EXPECT_LT((f - expected).norm(), 1e-13 * expected.norm());
}

TEST(InternalForce, EqualsTheVoigtFormOfThePaperForEqualAndMixedDegrees) {
  expect_equals_voigt(models::distorted(models::block({1, 2, 1.5}, {2, 2, 2}, 1), 0.1));
  expect_equals_voigt(models::distorted(models::block({1, 2, 1.5}, {2, 1, 2}, 2), 0.05));
  expect_equals_voigt(models::distorted(models::block({1, 2, 1.5}, {1, 2, 1}, 3), 0.03));
  expect_equals_voigt(models::distorted(models::block({1, 2, 1.5}, {2, 2, 1}, {1, 2, 4}), 0.03));
  expect_equals_voigt(models::quarter_ring(2, 2));
  expect_equals_voigt(models::quarter_ring(3, 1));
}

TEST(InternalForce, IsTheGradientOfTheStrainEnergy) {
  const Solid solid(models::quarter_ring(2, 2), models::elastic());
  const NodalVectors u = models::random_vectors(solid.node_count(), 1),
                     du = models::random_vectors(solid.node_count(), 2);
  NodalVectors f(3, solid.node_count());
  solid.internal_force(u, f);
  const double step = 1e-4;  // the energy is quadratic: central differences are exact
  const double slope = (solid.strain_energy(u + step * du) - solid.strain_energy(u - step * du)) / (2 * step);
  EXPECT_NEAR(f.cwiseProduct(du).sum(), slope, 1e-9 * std::abs(slope));
  EXPECT_NEAR(solid.strain_energy(u), 0.5 * f.cwiseProduct(u).sum(), 1e-12 * solid.strain_energy(u));
}

/// Largest residual at interior nodes under u = H X, relative to the largest force on the boundary.
double patch_test_residual(const Solid& solid) {
  NodalVectors f(3, solid.node_count());
  solid.internal_force(models::linear_field(models::some_gradient(), solid.reference()), f);
  const std::vector<int> interior = models::interior_nodes(solid.space());
  return f(Eigen::all, interior).cwiseAbs().maxCoeff() / f.cwiseAbs().maxCoeff();
}

/// Largest error of the interior displacements when the boundary is given u = H X, relative to the largest
/// displacement.
double patch_test_error(const Solid& solid) {
  const NodalVectors exact = models::linear_field(models::some_gradient(), solid.reference());
  NodalVectors boundary = exact, f(exact);
  std::vector<int> dofs;
  for (int A : models::interior_nodes(solid.space())) {
    boundary.col(A).setZero();
    for (int i = 0; i < 3; ++i) dofs.push_back(3 * A + i);
  }
  solid.internal_force(boundary, f);
  const Eigen::MatrixXd K = models::stiffness(solid)(dofs, dofs);
  const Eigen::VectorXd residual = f.reshaped()(dofs);
  const Eigen::VectorXd u = -K.ldlt().solve(residual);
  return (u - exact.reshaped()(dofs)).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff();
}

nurbs::Volume elevated(nurbs::Volume patch) {
  for (int d = 0; d < 3; ++d) patch = nurbs::elevate_degree(patch, d);
  return patch;
}

// PHYSICS C1.  p + 1 Gauss points are exact for a map of degree 2 in a space of degree 2 or 3.
TEST(PatchTest, IsPassedByAffineAndDistortedPolynomialPatches) {
  const nurbs::Volume affine = models::block({1, 2, 3}, {3, 3, 3}, 2),
                      affine_cubic = models::block({1, 2, 3}, {2, 2, 2}, 3);
  const nurbs::Volume quadratic = models::distorted(models::block({3, 3, 3}, {3, 3, 3}, 2), 0.2);
  const nurbs::Volume cubic = elevated(models::distorted(models::block({2, 2, 2}, {2, 2, 1}, 2), 0.2));
  for (const nurbs::Volume& patch : {affine, affine_cubic, quadratic, cubic}) {
    const Solid solid(patch, models::elastic());
    EXPECT_LT(patch_test_residual(solid), 1e-13);
    EXPECT_LT(patch_test_error(solid), 1e-10);
  }
}

// PHYSICS C1b: a rational patch passes up to quadrature.
TEST(PatchTest, IsPassedByARationalRingUpToQuadrature) {
  EXPECT_LT(patch_test_error(Solid(models::quarter_ring(2, 4), models::elastic())), 5e-6);
  EXPECT_LT(patch_test_error(Solid(models::quarter_ring(3, 4), models::elastic())), 2e-7);
}

TEST(Solid, VolumeOfARationalRing) {
  EXPECT_NEAR(Solid(models::quarter_ring(2, 4), models::elastic()).volume(), 0.75 * kPi, 2e-8);
  EXPECT_NEAR(Solid(models::quarter_ring(3, 4), models::elastic()).volume(), 0.75 * kPi, 1e-9);
}

TEST(InternalForce, VanishesInRigidMotion) {
  const Solid solid(models::quarter_ring(2, 3), models::elastic());
  NodalVectors f(3, solid.node_count());
  solid.internal_force(Vector3(1, -2, 3).replicate(1, solid.node_count()), f);
  EXPECT_LT(f.cwiseAbs().maxCoeff(), 1e-12);
  const Matrix3 H = models::some_gradient();
  solid.internal_force(models::linear_field(H - H.transpose(), solid.reference()), f);
  EXPECT_LT(f.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(InternalForce, HasASymmetricStiffnessWithExactlySixZeroModes) {
  for (int degree : {1, 2, 3}) {
    const Solid solid(models::distorted(models::block({2, 2, 1}, {2, 2, 1}, degree), 0.05),
                      models::elastic());
    const Eigen::MatrixXd K = models::stiffness(solid);
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-14 * K.cwiseAbs().maxCoeff());
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
    const double largest = eigenvalues[eigenvalues.size() - 1];
    EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-13 * largest);
    EXPECT_GT(eigenvalues[6], 1e-6 * largest);
  }
}

TEST(Stress, OfALinearFieldIsTheSameEverywhere) {
  const Solid solid(models::quarter_ring(2, 2), models::elastic());
  const Matrix3 H = models::some_gradient();
  const NodalVectors u = models::linear_field(H, solid.reference());
  for (const nurbs::Parameter<3>& xi :
       {nurbs::Parameter<3>{0.0, 0.0, 0.0}, {0.3, 0.6, 0.9}, {1.0, 0.5, 1.0}}) {
    EXPECT_LT((solid.displacement_gradient(u, xi) - H).norm(), 1e-12);
    EXPECT_LT((solid.stress(u, xi) - (*solid.materials().front()).stress(H, nullptr)).norm(), 1e-12);
  }
}

TEST(RowSumMass, SumsToDensityTimesVolumeAndIsPositive) {
  const Solid solid(models::quarter_ring(2, 3), models::elastic(1.0, 0.3, 7850.0));
  EXPECT_GT(solid.row_sum_mass().minCoeff(), 0.0);
  EXPECT_NEAR(solid.row_sum_mass().sum(), 7850.0 * solid.volume(), 1e-9);
  // The element masses are the same mass, sorted by element.
  double sum = 0.0;
  for (int e = 0; e < solid.space().element_count(); ++e)
    for (int a = 0; a < solid.padded_functions(e); ++a) sum += solid.element_mass(e)[a];
  EXPECT_NEAR(sum, solid.row_sum_mass().sum(), 1e-9);
}

// PHYSICS C16: sum m_A x_A^2 over the exact integral.
TEST(RowSumMass, OverestimatesRotationalInertiaAsKnown) {
  struct Case {
    int degree, elements;
    double ratio;
  };
  for (const Case& c : {Case{1, 4, 1.125}, Case{2, 2, 1.5}, Case{2, 4, 1.15625}, Case{2, 6, 1.074074},
                        Case{2, 8, 1.042969}, Case{3, 6, 1.089506}, Case{3, 12, 1.025077}}) {
    const Solid solid(models::block({1, 1, 1}, {c.elements, 1, 1}, {c.degree, 1, 1}), models::elastic());
    const Eigen::ArrayXd x = solid.reference().row(0).array() - 0.5;
    EXPECT_NEAR((solid.row_sum_mass().array() * x * x).sum() * 12.0, c.ratio, 1e-6)
        << c.degree << ' ' << c.elements;
  }
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

// Kernels go over whole vectors: what lies beyond an element's functions must be a number, and 0.
TEST(Solid, GathersZerosBeyondTheFunctions) {
  const Solid solid(models::block({1, 1, 1}, {2, 2, 2}, 2), models::elastic());
  const int functions = 27, padded = solid.padded_functions(0);
  ASSERT_GT(padded, functions);
  std::vector<double> values(3 * padded, std::nan(""));
  solid.gather(3, NodalVectors::Ones(3, solid.node_count()), values.data());
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < padded; ++a) EXPECT_EQ(values[i * padded + a], a < functions ? 1.0 : 0.0);
}

// A displacement that is no number at one of two quadrature points, whichever it is.
TEST(Solid, HasNoSmallestVolumeRatioWhereItIsNoNumber) {
  constexpr int kPadded = 4;
  const double u[3 * kPadded] = {}, wJ[2] = {1.0, 1.0};
  const int slot[2] = {0, 1};
  for (const int point : {0, 1}) {
    double dR_dX[2 * 3 * kPadded] = {};
    EXPECT_EQ(structure::smallest_volume_ratio({dR_dX, wJ, slot, 2, kPadded}, u), 1.0);
    dR_dX[3 * kPadded * point] = std::nan("");
    EXPECT_TRUE(std::isnan(structure::smallest_volume_ratio({dR_dX, wJ, slot, 2, kPadded}, u))) << point;
  }
}

// 80 bytes at each of 27 points of an element: 485 elements have a megabyte.
TEST(Solid, FindsTheJacobianByTheWayThatIsFastest) {
  using structure::IntegrationMethod;
  const auto chosen = [](const nurbs::Volume& patch) {
    return Solid(patch, models::elastic()).integration().method;
  };
  EXPECT_EQ(chosen(models::block({1, 2, 3}, {9, 9, 6}, 2)), IntegrationMethod::affine);
  EXPECT_EQ(chosen(models::distorted(models::block({1, 1, 1}, {8, 10, 6}, 2), 0.01)),
            IntegrationMethod::stored);
  EXPECT_EQ(chosen(models::distorted(models::block({1, 1, 1}, {9, 9, 6}, 2), 0.01)),
            IntegrationMethod::recomputed);
  EXPECT_EQ(chosen(models::block({1, 1, 1}, {2, 2, 2}, 6)), IntegrationMethod::elements);
}

TEST(Solid, RefusesAPatchWithANegativeJacobianAndSaysWhere) {
  nurbs::Volume mirrored = models::block({1, 1, 1}, {2, 1, 1}, 2);
  mirrored.control_points.row(2) *= -1.0;
  EXPECT_THAT(message_of([&] { Solid(mirrored, models::elastic()); }),
              testing::AllOf(testing::HasSubstr("element 0"), testing::HasSubstr("expected > 0")));
  nurbs::Volume folded = models::block({1, 1, 1}, {3, 1, 1}, 1);
  for (int A : {3, 7, 11, 15}) folded.control_points(0, A) = 0.5;  // the last element turns round
  EXPECT_THAT(message_of([&] { Solid(folded, models::elastic()); }), testing::HasSubstr("element 2"));
}

// A part has the control points of its own elements alone, and says the same of what it holds.
TEST(Solid, APartIsTheWholeWhereItIs) {
  const nurbs::Volume patch =
      models::distorted(models::block({1, 2, 1}, {3, structure::kBoxSpans[1] + 7, 2}, 2), 0.004);
  const nurbs::Space<3>& space = patch.space;
  const Solid whole(patch, models::elastic());
  const NodalVectors u = 0.01 * models::random_vectors(whole.node_count(), 3);
  const structure::Partition partition(space, structure::box_cuts(space), 2);
  for (int p = 0; p < 2; ++p) {
    const structure::Part part = partition.part(p);
    const Solid own(patch, models::elastic(), {}, part);
    NodalVectors u_own = NodalVectors::Zero(3, part.columns);
    for (int column = 0; column < part.held(); ++column) {
      u_own.col(column) = u.col(part.nodes[column]);
      EXPECT_EQ(own.reference().col(column), patch.control_points.col(part.nodes[column]));
    }
    const nurbs::Parameter<3> xi{0.4, p == 0 ? 0.1 : 0.9, 0.7};
    EXPECT_EQ(own.stress(u_own, xi), whole.stress(u, xi));
    for (int e = 0; e < own.element_count(); ++e) {
      const int id = static_cast<int>(part.element(e));
      EXPECT_EQ(own.describe_element(e), whole.describe_element(id));
      EXPECT_EQ(own.element_mass(e)[0], whole.element_mass(id)[0]);
    }
  }
}

}  // namespace
