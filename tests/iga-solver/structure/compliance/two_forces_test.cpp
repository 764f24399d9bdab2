// SPDX-License-Identifier: GPL-2.0-or-later
// Two contacts near each other: what a mesh gives way at one foot under a force at another is taken as the
// body's own, and nothing is taken off.  What is wrong then is, of what is taken off for the force itself, at
// most 9 % if feet are one element apart along the mesh, a fifth if across it, as its elements are longer
// there, and a seventh from 5/4 of an element on.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "point_force.h"
#include "structure/compliance/compliance_tables.h"

namespace {

using nurbs::Parameter;
using point_force::displacements;
using point_force::unit_force;

// A block of 14 x 14 x 5 cubes of size 1 on a rigid base.
constexpr double kWide = 14, kDeep = 5;

/// At distances from a foot, along a diagonal or not.
std::vector<double> beside(int finer, const Parameter<2>& foot, const std::vector<Parameter<2>>& others) {
  const int wide = finer * static_cast<int>(kWide);
  const structure::ReferenceBody body =
      point_force::block_body({kWide, kWide, kDeep}, {wide, wide, finer * static_cast<int>(kDeep)}, 2);
  const auto on_base = [](const nurbs::Vector3& X) { return X[2] < 1e-9; };
  const nurbs::NodalVectors u =
      displacements(body, unit_force(body, {foot[0] / kWide, foot[1] / kWide}), on_base);
  std::vector<double> found;
  for (const Parameter<2>& other : others)
    found.push_back(u.cwiseProduct(unit_force(body, {other[0] / kWide, other[1] / kWide})).sum());
  return found;
}

/// Of c, at this distance and angle to the mesh.
double most(double distance, double angle) {
  if (distance < 1.25) return angle == 0.0 ? 0.09 : 0.21;
  return distance < 2.0 ? 0.14 : distance < 3.0 ? 0.065 : 0.02;
}

TEST(TwoForces, FeelEachOtherThroughTheMeshAsThroughTheBody) {
  const structure::ReferenceBody body = point_force::block_body({kWide, kWide, kDeep}, {14, 14, 5}, 2);
  structure::ComplianceTables tables(body, point_force::kTop);
  for (const Parameter<2>& foot : {Parameter<2>{7, 7}, {7.5, 7.5}, {7.2, 7.35}}) {
    std::vector<Parameter<2>> others;
    std::vector<double> distances, angles;
    for (const double s : {1.0, 1.25, 1.5, 2.0, 3.0, 4.0})
      for (const double angle : {0.0, 0.4, 0.785}) {
        others.push_back({foot[0] + s * std::cos(angle), foot[1] + s * std::sin(angle)});
        distances.push_back(s);
        angles.push_back(angle);
      }
    const auto mesh = beside(1, foot, others), fine = beside(3, foot, others);
    const int element = static_cast<int>(foot[0]) + 14 * static_cast<int>(foot[1]);
    const double c = tables.direct(0, element, {foot[0] / kWide, foot[1] / kWide})(2, 2);
    for (std::size_t k = 0; k < others.size(); ++k) {
      EXPECT_LT(std::abs(mesh[k] - fine[k]), most(distances[k], angles[k]) * c)
          << foot[0] << ' ' << foot[1] << ", " << others[k][0] << ' ' << others[k][1];
    }
  }
}

}  // namespace
