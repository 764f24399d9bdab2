// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "models.h"
#include "structure/material/plate_material.h"

namespace {

using models::Matrix3;
using models::Vector3;
using testing::HasSubstr;
using testing::ThrowsMessage;

const structure::LinearElastic kLinear(2.0, 0.3, 1.0);
const structure::SaintVenantKirchhoff kLarge(2.0, 0.3, 1.0);

// In a plate across z.
TEST(PlateShear, IsLessAcrossThePlateAndTheLawElsewhere) {
  const Matrix3 H = models::some_gradient();
  Matrix3 expected = kLinear.stress(H, nullptr);
  for (int i = 0; i < 2; ++i) {
    expected(i, 2) *= 5.0 / 5.7;
    expected(2, i) *= 5.0 / 5.7;
  }
  const auto plate = structure::with_plate_shear(kLinear, {0, 0, 2});
  EXPECT_LT((plate->stress(H, nullptr) - expected).norm(), 1e-15 * expected.norm());
  EXPECT_TRUE(plate->is_linear());
  EXPECT_STREQ(plate->law(), "linear_elastic, shear corrected");
}

TEST(PlateShear, TurnsWithThePlate) {
  const Matrix3 H = 0.2 * models::some_gradient();
  const Matrix3 Q = Eigen::AngleAxisd(2.0, Vector3(1, -2, 3).normalized()).toRotationMatrix();
  for (const structure::Material* law : {static_cast<const structure::Material*>(&kLinear),
                                         static_cast<const structure::Material*>(&kLarge)}) {
    const auto level = structure::with_plate_shear(*law, Vector3::UnitZ());
    const auto turned = structure::with_plate_shear(*law, Q.col(2));
    const Matrix3 P = Q * level->stress(H, nullptr) * Q.transpose(), turned_H = Q * H * Q.transpose();
    EXPECT_LT((turned->stress(turned_H, nullptr) - P).norm(), 1e-14 * P.norm());
  }
}

TEST(PlateShear, IsKnownOfTwoLaws) {
  for (const structure::MaterialLaw& law : structure::material_laws()) {
    if (law.word == std::string("linear_elastic") || law.word == std::string("saint_venant_kirchhoff"))
      continue;
    EXPECT_THAT([&] { structure::with_plate_shear(*models::make_law(law), Vector3::UnitX()); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(law.word)));
  }
  EXPECT_THROW(structure::with_plate_shear(kLinear, Vector3::Zero()), std::invalid_argument);
  // Of a plate already.
  const auto plate = structure::with_plate_shear(kLinear, Vector3::UnitX());
  EXPECT_THROW(structure::with_plate_shear(*plate, Vector3::UnitX()), std::invalid_argument);
}

}  // namespace
