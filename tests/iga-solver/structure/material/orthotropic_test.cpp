// SPDX-License-Identifier: GPL-2.0-or-later
// The orthotropic law beside its own engineering constants and the isotropic laws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <stdexcept>

#include "models.h"
#include "structure/material/laws.h"

namespace {

using structure::Matrix3;
using structure::OrthotropicConstants;
using structure::OrthotropicSolid;
using testing::HasSubstr;
using Vector3 = Eigen::Vector3d;

const OrthotropicConstants kWood{{12e9, 0.9e9, 0.5e9}, {0.4, 0.45, 0.5}, {0.8e9, 0.6e9, 0.05e9}, 500.0,
                                 {1, 2, -0.5},         {3, -1, 1}};

// Six small strains along the material's own axes give its compliance; Voigt's order 11, 22, 33, 12, 13, 23.
TEST(Orthotropic, HasItsNineConstantsAlongItsAxes) {
  const OrthotropicSolid law(kWood);
  const Vector3 e1 = kWood.direction_1.normalized(), e3 = e1.cross(kWood.direction_2).normalized();
  Matrix3 R;
  R << e1, e3.cross(e1), e3;
  constexpr int kRow[] = {0, 1, 2, 0, 0, 1}, kColumn[] = {0, 1, 2, 1, 2, 2};
  constexpr double kSmall = 1e-11;
  Eigen::Matrix<double, 6, 6> C;
  for (int b = 0; b < 6; ++b) {
    Matrix3 strain = Matrix3::Zero();
    strain(kRow[b], kColumn[b]) += 0.5;
    strain(kColumn[b], kRow[b]) += 0.5;
    const Matrix3 stress = R.transpose() * law.stress(kSmall * (R * strain * R.transpose()), nullptr) * R;
    for (int a = 0; a < 6; ++a) C(a, b) = stress(kRow[a], kColumn[a]) / kSmall;
  }
  const Eigen::Matrix<double, 6, 6> S = C.inverse();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(1.0 / S(i, i), kWood.E[i], 1e-9 * kWood.E[i]);
    EXPECT_NEAR(1.0 / S(3 + i, 3 + i), kWood.G[i], 1e-9 * kWood.G[i]);
    EXPECT_NEAR(-S(kRow[3 + i], kColumn[3 + i]) * kWood.E[kRow[3 + i]], kWood.nu[i], 1e-9);
    EXPECT_LT(S.block(0, 3, 3, 3).cwiseAbs().maxCoeff(), 1e-9 / kWood.E[0]) << "no shear by stretch";
  }
}

TEST(Orthotropic, IsTheIsotropicLawWhereItsConstantsAre) {
  const double E = 210.0, nu = 0.29, G = E / (2.0 * (1.0 + nu));
  const OrthotropicSolid law(
      OrthotropicConstants{{E, E, E}, {nu, nu, nu}, {G, G, G}, 1.0, {1, 2, -0.5}, {3, -1, 1}});
  EXPECT_NEAR(law.youngs_modulus(), E, 1e-13 * E);
  EXPECT_NEAR(law.poissons_ratio(), nu, 1e-14);
  const Matrix3 H = 0.3 * models::some_gradient(), small = 1e-15 * H;
  const Matrix3 P = structure::SaintVenantKirchhoff(E, nu, 1.0).stress(H, nullptr);
  EXPECT_LT((law.stress(H, nullptr) - P).norm(), 1e-13 * P.norm());
  const Matrix3 sigma = structure::LinearElastic(E, nu, 1.0).stress(small, nullptr);
  EXPECT_LT((law.stress(small, nullptr) - sigma).norm(), 1e-13 * sigma.norm());
}

// The energy is of fourth degree: Richardson's differences have no error left.
TEST(Orthotropic, StressIsTheDerivativeOfTheEnergy) {
  const OrthotropicSolid law(kWood);
  const Matrix3 H = 0.2 * models::some_gradient(), P = law.stress(H, nullptr);
  for (int k = 0; k < 9; ++k) {
    const auto slope = [&](double step) {
      Matrix3 dH = Matrix3::Zero();
      dH(k / 3, k % 3) = step;
      return (law.energy_density(H + dH, nullptr) - law.energy_density(H - dH, nullptr)) / (2.0 * step);
    };
    EXPECT_NEAR(P(k / 3, k % 3), (4.0 * slope(1e-3) - slope(2e-3)) / 3.0, 1e-11 * P.norm());
  }
}

TEST(Orthotropic, NamesTheConditionThatItsConstantsBreak) {
  const auto said = [](auto change) -> std::string {
    OrthotropicConstants constants = kWood;
    change(constants);
    try {
      OrthotropicSolid{constants};
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  const double nan = std::nan("");
  EXPECT_EQ(said([](auto&) {}), "accepted");
  EXPECT_THAT(said([](auto& c) { c.E[1] = -1.0; }), HasSubstr("E_2 is -1"));
  EXPECT_THAT(said([&](auto& c) { c.G[2] = nan; }), HasSubstr("G_23 is nan"));
  EXPECT_THAT(said([](auto& c) { c.density = 0.0; }), HasSubstr("density is 0"));
  EXPECT_THAT(said([](auto& c) { c.nu[0] = 3.7; }), HasSubstr("less than sqrt(E_1 / E_2) = 3.65"));
  EXPECT_THAT(said([](auto& c) { c.nu[2] = -1.35; }), HasSubstr("nu_23 is -1.35"));
  EXPECT_THAT(said([&](auto& c) { c.nu[1] = nan; }), HasSubstr("nu_13 is nan"));
  EXPECT_THAT(said([](auto& c) {
                c.E = {1, 1, 1}, c.nu = {0.6, 0.6, 0.6};
              }),
              HasSubstr("2 nu_21 nu_32 nu_13 is -0.512"));
  EXPECT_THAT(said([](auto& c) { c.direction_2 = -2.0 * c.direction_1; }), HasSubstr("span a plane"));
}

}  // namespace
