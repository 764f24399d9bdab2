// SPDX-License-Identifier: GPL-2.0-or-later
// Every law passes the same properties: a new one is tested by being listed in kLaws, and in kLargeStrainLaws
// if it is objective.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "models.h"
#include "standard_linear_solid.h"
#include "structure/material/laws.h"
#include "structure/material/plate_material.h"

namespace {

using structure::LinearElastic;
using structure::Material;
using structure::Matrix3;
using structure::NeoHooke;
using structure::SaintVenantKirchhoff;
using test::StandardLinearSolid;

constexpr double kE = 210.0, kNu = 0.29, kDensity = 7.8;

/// Of isotropic constants, in any axes.
std::shared_ptr<const Material> isotropic_orthotropic() {
  const double G = kE / (2.0 * (1.0 + kNu));
  return std::make_shared<structure::OrthotropicSolid>(structure::OrthotropicConstants{
      {kE, kE, kE}, {kNu, kNu, kNu}, {G, G, G}, kDensity, {1, 2, 3}, {0, 1, -1}});
}

std::shared_ptr<const Material> plate(const Material& law) {
  return structure::with_plate_shear(law, Eigen::Vector3d::UnitZ());
}

class EveryLaw : public testing::TestWithParam<std::shared_ptr<const Material>> {
 protected:
  /// What a point remembers before the first step.
  const std::vector<double> fresh = std::vector<double>(GetParam()->state_size());
  const double* const rest = fresh.data();
};

// Differences by Richardson's rule, error of fourth order.
TEST_P(EveryLaw, StressIsTheDerivativeOfTheEnergy) {
  const Material& material = *GetParam();
  const Matrix3 H = 0.1 * models::some_gradient();
  std::vector<double> memory = fresh;  // of another deformation
  material.evolve(0.4 * H.transpose(), 0.7, rest, memory.data());
  Matrix3 P;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto slope = [&](double step) {
        Matrix3 dH = Matrix3::Zero();
        dH(i, j) = step;
        return (material.energy_density(H + dH, memory.data()) -
                material.energy_density(H - dH, memory.data())) /
               (2.0 * step);
      };
      P(i, j) = (4.0 * slope(1e-3) - slope(2e-3)) / 3.0;
    }
  EXPECT_LT((material.stress(H, memory.data()) - P).norm(), 1e-10 * P.norm());
}

TEST_P(EveryLaw, IsFreeOfStressInARigidInfinitesimalRotation) {
  const Matrix3 H = models::some_gradient();
  const Matrix3 spin = 1e-9 * (H - H.transpose());
  EXPECT_LT(GetParam()->stress(spin, rest).norm(), 1e-16 * kE);
}

TEST_P(EveryLaw, HasItsElasticConstantsAtSmallStrain) {
  const Material& material = *GetParam();
  EXPECT_EQ(material.density(), kDensity);
  EXPECT_NEAR(material.youngs_modulus(), kE, 1e-13 * kE);
  EXPECT_NEAR(material.poissons_ratio(), kNu, 1e-14);
  const double stretch = 1e-7;
  const Matrix3 uniaxial = Eigen::Vector3d(stretch, -kNu * stretch, -kNu * stretch).asDiagonal();
  Matrix3 expected = Matrix3::Zero();
  expected(0, 0) = kE * stretch;
  EXPECT_LT((material.stress(uniaxial, rest) - expected).norm(), 1e-6 * expected(0, 0));
}

// Dissipation, the second law: at a deformation that is held, memory only gives energy away.
TEST_P(EveryLaw, DoesNotGainEnergyByWaiting) {
  const Material& material = *GetParam();
  const Matrix3 H = 0.1 * models::some_gradient();
  std::vector<double> old = fresh, next = fresh;
  material.evolve(H, 0.0, rest, old.data());
  double energy = material.energy_density(H, old.data());
  for (int step = 0; step < 20; ++step) {
    material.evolve(H, 0.3, old.data(), next.data());
    EXPECT_LE(material.energy_density(H, next.data()), energy);
    energy = material.energy_density(H, next.data());
    old = next;
  }
}

INSTANTIATE_TEST_SUITE_P(kLaws, EveryLaw,
                         testing::Values(std::make_shared<LinearElastic>(kE, kNu, kDensity),
                                         std::make_shared<SaintVenantKirchhoff>(kE, kNu, kDensity),
                                         std::make_shared<NeoHooke>(kE, kNu, kDensity),
                                         isotropic_orthotropic(), plate(LinearElastic(kE, kNu, kDensity)),
                                         plate(SaintVenantKirchhoff(kE, kNu, kDensity)),
                                         std::make_shared<StandardLinearSolid>(kE, kNu, kDensity, 0.3, 2.0)));

class EveryLargeStrainLaw : public EveryLaw {};

// P(Q F) = Q P(F), and Q = I is the case of no rotation.
TEST_P(EveryLargeStrainLaw, TurnsItsStressWithTheBody) {
  const Material& material = *GetParam();
  const Matrix3 I = Matrix3::Identity(), F = I + 0.2 * models::some_gradient();
  const Matrix3 Q = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  const Matrix3 P = material.stress(F - I, rest);
  EXPECT_LT((material.stress(Q * F - I, rest) - Q * P).norm(), 1e-14 * P.norm());
  EXPECT_NEAR(material.energy_density(Q * F - I, rest), material.energy_density(F - I, rest), 1e-14 * kE);
  EXPECT_LT(material.stress(Q - I, rest).norm(), 1e-14 * kE);
}

// The moments of the Cauchy stress balance: P F^T is symmetric.
TEST_P(EveryLargeStrainLaw, ExertsNoCouple) {
  const Matrix3 F = Matrix3::Identity() + 0.2 * models::some_gradient();
  const Matrix3 tau = GetParam()->stress(F - Matrix3::Identity(), rest) * F.transpose();
  EXPECT_LT((tau - tau.transpose()).norm(), 1e-14 * tau.norm());
}

INSTANTIATE_TEST_SUITE_P(kLargeStrainLaws, EveryLargeStrainLaw,
                         testing::ValuesIn(models::large_strain_laws(kE)));

template <class Law>
class IsotropicLaw : public testing::Test {};
using IsotropicLaws = testing::Types<LinearElastic, SaintVenantKirchhoff, NeoHooke>;
TYPED_TEST_SUITE(IsotropicLaw, IsotropicLaws);

// Strains without rotation small enough for squares to vanish.
TYPED_TEST(IsotropicLaw, IsTheSmallStrainLawAtSmallStrain) {
  const Matrix3 H = 1e-15 * models::some_gradient();
  const Matrix3 expected = LinearElastic(kE, kNu, kDensity).stress(H, nullptr);
  EXPECT_LT((TypeParam(kE, kNu, kDensity).stress(H, nullptr) - expected).norm(), 1e-13 * expected.norm());
}

TYPED_TEST(IsotropicLaw, RefusesImpossibleConstants) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (double E : {0.0, -1.0, nan, infinity})
    EXPECT_THROW(TypeParam(E, 0.3, 1.0), std::invalid_argument) << E;
  for (double nu : {-1.0, 0.5, -2.0, 0.6, nan})
    EXPECT_THROW(TypeParam(1.0, nu, 1.0), std::invalid_argument) << nu;
  for (double density : {0.0, -1.0, nan})
    EXPECT_THROW(TypeParam(1.0, 0.3, density), std::invalid_argument) << density;
}

// PHYSICS C11's closed forms, at stretches of both sides of the series' border.
TEST(NeoHooke, HasTheClosedFormsOfVolumeChangeAndSimpleShear) {
  const double lambda = kE * kNu / ((1 + kNu) * (1 - 2 * kNu)), mu = kE / (2 * (1 + kNu));
  const NeoHooke law(kE, kNu, kDensity);
  for (const double s : {0.01, 0.5, 0.98, 0.9964, 0.9967, 1.0001, 1.0033, 1.0036, 1.2, 3.0}) {
    const double P = mu * (s - 1 / s) + 3 * lambda * std::log(s) / s, ln = std::log(s);
    const double W = 1.5 * mu * (s * s - 1) - 3 * mu * ln + 4.5 * lambda * ln * ln;
    const Matrix3 H = (s - 1.0) * Matrix3::Identity();
    EXPECT_LT((law.stress(H, nullptr) - P * Matrix3::Identity()).norm(), 1e-11 * std::abs(P)) << s;
    EXPECT_NEAR(law.energy_density(H, nullptr), W, 1e-13 * std::max(W, 1e-3 * kE)) << s;
  }
  const double gamma = 0.7;
  Matrix3 H = Matrix3::Zero(), sigma = Matrix3::Zero();
  H(0, 1) = gamma;
  sigma(0, 1) = sigma(1, 0) = mu * gamma;
  sigma(0, 0) = mu * gamma * gamma;
  const Matrix3 F = Matrix3::Identity() + H;
  EXPECT_LT((law.stress(H, nullptr) * F.transpose() - sigma).norm(), 1e-14 * kE);
}

TEST(NeoHooke, HasNoStressWhereThereIsNoVolumeLeft) {
  const NeoHooke law(kE, kNu, kDensity);
  for (const double s : {0.0, -0.5})
    EXPECT_TRUE(
        law.stress(Matrix3(Eigen::Vector3d(s - 1.0, 0, 0).asDiagonal()), nullptr).array().isNaN().any())
        << s;
}

}  // namespace
