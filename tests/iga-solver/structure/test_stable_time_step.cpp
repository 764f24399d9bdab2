// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "models.h"
#include "structure/stable_time_step.h"

namespace {

using models::NodalVectors;
using nurbs::Face;
using structure::LumpedMass;
using structure::Solid;
using structure::Supports;

double stable_step(const Solid& solid, const Supports& supports) {
  return structure::stable_time_step(solid, LumpedMass(solid.row_sum_mass()), supports,
                                     NodalVectors::Zero(3, solid.node_count()));
}

void fix(Supports& supports, const Solid& solid, std::initializer_list<Face> faces,
         structure::Directions directions) {
  for (Face face : faces) supports.fix(solid.patch().space, face, directions);
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
