// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of plates whose shear is corrected.  How large they are is held against an independent
// program in inputs/mesh_study, rows ..._shear_..._same_mesh.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "point_force.h"
#include "structure/compliance/compliance_tables.h"
#include "structure/material/plate_material.h"

namespace {

using models::Matrix3;
using models::Vector3;
using structure::ReferenceBody;

Matrix3 compliance_of(const ReferenceBody& body) {
  return structure::ComplianceTables(body, point_force::kTop).direct(0, 5 + 11 * 5, {0.47, 0.52});
}

// A body that has turned has the material that it had, whose axes turn with it.
TEST(PlateCompliance, TurnsWithTheBody) {
  ReferenceBody body = point_force::block_body({11, 11, 2}, {11, 11, 1}, 2);
  const Matrix3 plain = compliance_of(body);
  body.materials = {structure::with_plate_shear(*body.materials[0], Vector3::UnitZ())};
  const Matrix3 level = compliance_of(body);
  EXPECT_GT(level(2, 2), 1.02 * plain(2, 2));
  const Matrix3 Q = Eigen::AngleAxisd(2.0, Vector3(1, -2, 3).normalized()).toRotationMatrix();
  body.patches[0].control_points = Q * body.patches[0].control_points;
  EXPECT_LT((compliance_of(body) - Q * level * Q.transpose()).norm(), 1e-10 * level.norm());
}

}  // namespace
