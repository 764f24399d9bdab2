// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "models.h"
#include "structure/time/stable_time_step.h"

namespace {

using models::NodalVectors;
using nurbs::Face;
using structure::LumpedMass;
using structure::Solid;
using structure::Supports;
using testing::AllOf;
using testing::HasSubstr;

double stable_step(const Solid& solid, const Supports& supports) {
  return structure::stable_time_step(solid, LumpedMass(solid.row_sum_mass()), supports,
                                     NodalVectors::Zero(3, solid.node_count()));
}

void fix(Supports& supports, const Solid& solid, std::initializer_list<Face> faces,
         structure::Directions directions) {
  for (Face face : faces) supports.fix(structure::nodes_on(solid.patch().space, {face}), directions);
}

Supports clamped_at_xi_minus(const Solid& solid) {
  Supports supports;
  fix(supports, solid, {Face::xi_minus}, {true, true, true});
  return supports;
}

double dense_eigenvalue(const Solid& solid, const Supports& supports) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(models::mass_scaled_stiffness(solid, supports),
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

TEST(StableTimeStep, AgreesWithDenseEigenvaluesOnDistortedBlocks) {
  for (int degree : {1, 2, 3}) {
    const Solid solid(models::distorted(models::block({2, 2, 1}, {2, 2, 1}, degree), 0.05),
                      models::elastic());
    const Supports supports = clamped_at_xi_minus(solid);
    EXPECT_NEAR(stable_step(solid, supports) * std::sqrt(dense_eigenvalue(solid, supports)) / 2.0, 1.0, 1e-3);
  }
}

// The stiffness of a linear law does not know of the displacement about which it is taken.
TEST(StableTimeStep, OfALinearLawIsTheSameAboutAnyDisplacement) {
  const Solid solid(models::distorted(models::block({2, 2, 1}, {2, 2, 1}, 2), 0.05), models::elastic());
  const LumpedMass mass(solid.row_sum_mass());
  const Supports supports = clamped_at_xi_minus(solid);
  NodalVectors u = models::random_vectors(solid.node_count(), 9);
  supports.apply(u);
  EXPECT_NEAR(structure::stable_time_step(solid, mass, supports, u) / stable_step(solid, supports), 1.0,
              1e-3);
}

// PHYSICS C7.  A bar: nu = 0, the sides held, one linear element across; the section is so wide that its
// shear modes (1e-4 of the eigenvalue) do not matter.
TEST(StableTimeStep, OfALumpedBarIsTheKnownOneDimensionalValue) {
  const double expected[] = {1.0, 0.86206, 0.65274};  // times h/c, p = 1, 2, 3
  for (int degree : {1, 2, 3}) {
    const int elements = 6;
    const Solid solid(models::block({1.0 * elements, 100, 100}, {elements, 1, 1}, {degree, 1, 1}),
                      models::elastic(1.0, 0.0, 1.0));
    Supports supports;
    fix(supports, solid, {Face::eta_minus, Face::zeta_minus}, {false, true, true});
    fix(supports, solid, {Face::eta_plus, Face::zeta_plus}, {false, true, true});
    EXPECT_NEAR(stable_step(solid, supports), expected[degree - 1], 1e-3) << "degree " << degree;
  }
}

// PHYSICS C15: 4 x 4 x 4 quadratic unit cubes, free.
TEST(StableTimeStep, OfAFreeBlockIsThatOfAnIndependentCode) {
  const Solid solid(models::block({4, 4, 4}, {4, 4, 4}, 2), models::elastic());
  EXPECT_NEAR(stable_step(solid, {}), 0.6454, 0.005 * 0.6454);
}

// PHYSICS A8: the plate of Table 2 in Gao & Feng (2019).
TEST(StableTimeStep, OfThePapersPlateIsThatOfAnIndependentCode) {
  const Solid solid(models::block({0.610, 0.610, 0.0501}, {31, 31, 8}, 2),
                    models::elastic(210.6e9, 0.286, 7850));
  Supports supports;
  fix(supports, solid, {Face::xi_minus, Face::xi_plus, Face::eta_minus, Face::eta_plus}, {true, true, true});
  EXPECT_NEAR(stable_step(solid, supports), 9.19e-7, 0.03 * 9.19e-7);
}

TEST(StableTimeStep, IsInfiniteWhenNothingCanMove) {
  const Solid solid(models::block({1, 1, 1}, {1, 1, 1}, 1), models::elastic());
  Supports supports;
  fix(supports, solid, {Face::xi_minus, Face::xi_plus}, {true, true, true});
  EXPECT_EQ(stable_step(solid, supports), std::numeric_limits<double>::infinity());
}

TEST(StableTimeStep, RefusesAResultOutsideTheElementBounds) {
  const Solid solid(models::block({2, 2, 1}, {2, 2, 1}, 2), models::elastic());
  const NodalVectors at_rest = NodalVectors::Zero(3, solid.node_count());
  for (double factor : {0.01, 100.0})
    EXPECT_THROW(structure::stable_time_step(solid, LumpedMass(factor * solid.row_sum_mass()), {}, at_rest),
                 std::logic_error);
}

// Eigenvalues of matrices that are not finite would be sought for ever.
TEST(StableTimeStep, RefusesNumbersThatAreNotFinite) {
  const auto message = [](const Solid& solid, const NodalVectors& u) -> std::string {
    try {
      structure::stable_time_step(solid, LumpedMass(solid.row_sum_mass()), {}, u);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "accepted";
  };
  const Solid solid(models::block({1, 1, 1}, {2, 1, 1}, 2), models::elastic());
  NodalVectors u = NodalVectors::Zero(3, solid.node_count());
  for (double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    u(1, 5) = value;
    EXPECT_THAT(message(solid, u), HasSubstr("displacements that are not finite"));
  }
  u.setZero();
  // Numbers that may be given, but whose quotient is not one: too large, and too small.
  const Solid stiff(models::block({1e-60, 1e-60, 1e-60}, {2, 1, 1}, 2), models::elastic(1e100, 0.3, 1e-100));
  EXPECT_THAT(message(stiff, u), AllOf(HasSubstr("no finite number"), HasSubstr("Young's modulus 1e+100"),
                                       HasSubstr("density 1e-100"), HasSubstr("about 7.94e-61")));
  const Solid soft(models::block({1e70, 1e70, 1e70}, {2, 1, 1}, 2), models::elastic(1e-100, 0.3, 1e90));
  EXPECT_THAT(message(soft, u),
              AllOf(HasSubstr("no finite number > 0"), HasSubstr("Young's modulus 1e-100")));
}

TEST(ElementEigenvalueBounds, RefuseNumbersThatAreNotFinite) {
  const Solid solid(models::block({1, 1, 1}, {2, 1, 1}, 2), models::elastic());
  NodalVectors u = NodalVectors::Zero(3, solid.node_count());
  u(1, 3) = std::numeric_limits<double>::quiet_NaN();  // of the second element alone
  EXPECT_THAT([&] { structure::element_eigenvalue_bounds(solid, {}, u); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("in element 1")));
}

TEST(ElementEigenvalueBounds, EncloseTheLargestEigenvalue) {
  for (int degree : {1, 2, 3}) {
    const Solid solid(models::distorted(models::block({3, 2, 1}, {2, 2, 1}, degree), 0.05),
                      models::elastic());
    const Supports supports = clamped_at_xi_minus(solid);
    const double exact = dense_eigenvalue(solid, supports);
    const structure::EigenvalueBounds bounds =
        structure::element_eigenvalue_bounds(solid, supports, NodalVectors::Zero(3, solid.node_count()));
    EXPECT_LT(bounds.low, exact);
    EXPECT_GT(1.02 * bounds.high, exact);
    EXPECT_LT(bounds.high, 30.0 * bounds.low);  // or the bounds would say nothing
  }
}

}  // namespace
