// SPDX-License-Identifier: GPL-2.0-or-later
// Two contacts near each other: what a mesh gives way at one foot under a force at another is the body's own,
// less what links between nodes take off, to an eighth of what is taken off for the force itself, from one
// element's length on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "point_force.h"
#include "structure/compliance/compliance_tables.h"
#include "structure/compliance/cross_compliance.h"

namespace {

using nurbs::Parameter;
using point_force::displacements;
using point_force::unit_force;

// A block of 14 x 14 x 5 on a rigid base.
constexpr double kWide = 14, kDeep = 5;

structure::ReferenceBody block(int wide, int deep, int degree, double nu) {
  const nurbs::Volume patch = models::block({kWide, kWide, kDeep}, {wide, wide, deep}, degree);
  return {{patch}, {models::elastic(1.0, nu)}, structure::without_welds({patch})};
}

using structure::CrossCompliance;

/// Displacements at feet by a force at another, in elements of an own number to a unit of length.
std::vector<double> beside(int finer, int degree, double nu, const Parameter<2>& foot,
                           const std::vector<Parameter<2>>& others) {
  const int wide = finer * static_cast<int>(kWide);
  const structure::ReferenceBody body = block(wide, finer * static_cast<int>(kDeep), degree, nu);
  const auto on_base = [](const nurbs::Vector3& X) { return X[2] < 1e-9; };
  const nurbs::NodalVectors u =
      displacements(body, unit_force(body, {foot[0] / kWide, foot[1] / kWide}), on_base);
  std::vector<double> found;
  for (const Parameter<2>& other : others)
    found.push_back(u.cwiseProduct(unit_force(body, {other[0] / kWide, other[1] / kWide})).sum());
  return found;
}

/// What links take off at one foot for a unit force at the other.
double taken_off(const CrossCompliance& cross, const structure::SkinPoint& foot,
                 const structure::SkinPoint& other) {
  const auto share = [](const structure::SkinPoint& of, structure::Id node) {
    const auto at = std::find(of.nodes.begin(), of.nodes.end(), node);
    return at == of.nodes.end() ? 0.0 : of.R[at - of.nodes.begin()];
  };
  double sum = 0.0;
  for (const auto& [first, second, give] : cross.links())
    sum += give * (share(foot, first) - share(foot, second)) * (share(other, first) - share(other, second));
  return sum;
}

/// What is wrong at distances from a foot, along a diagonal or not, over c at the foot; and without links.
struct Wrong {
  double with_links = 0.0, without = 0.0;
};
Wrong wrong_beside(const Parameter<2>& foot, int degree, double nu, const std::vector<double>& distances,
                   const std::vector<double>& angles = {0.0, 0.4, 0.785}) {
  const structure::ReferenceBody body = block(static_cast<int>(kWide), static_cast<int>(kDeep), degree, nu);
  structure::ComplianceTables tables(body, point_force::kTop);
  const CrossCompliance cross(body, point_force::kTop);
  const structure::FaceSurface top(body, point_force::kTop[0]);
  const auto at = [&](const Parameter<2>& place) {
    const Parameter<2> xi{place[0] / kWide, place[1] / kWide};
    return top.at(top.space().element_at(xi), xi);
  };
  std::vector<Parameter<2>> others;
  for (const double s : distances)
    for (const double angle : angles)
      others.push_back({foot[0] + s * std::cos(angle), foot[1] + s * std::sin(angle)});
  const auto mesh = beside(1, degree, nu, foot, others), fine = beside(3, degree, nu, foot, others);
  const int element = static_cast<int>(foot[0]) + static_cast<int>(kWide) * static_cast<int>(foot[1]);
  const double c = tables.direct(0, element, {foot[0] / kWide, foot[1] / kWide})(2, 2);
  Wrong most;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const structure::SkinPoint here = at(foot), there = at(others[k]);
    EXPECT_NEAR(cross.taken_at({here})[0], taken_off(cross, here, here), 1e-12 * c);
    const double without = mesh[k] - fine[k], with_links = without - taken_off(cross, here, there);
    most.without = std::max(most.without, std::abs(without) / c);
    most.with_links = std::max(most.with_links, std::abs(with_links) / c);
  }
  return most;
}

TEST(TwoForces, FeelEachOtherThroughTheMeshAsThroughTheBody) {
  // In a corner of elements, the middle of one, between, and near one of two opposite corners.
  for (const Parameter<2>& foot : {Parameter<2>{7, 7}, {7.5, 7.5}, {7.2, 7.35}, {7.146, 7.146}}) {
    SCOPED_TRACE(testing::PrintToString(foot));
    EXPECT_LT(wrong_beside(foot, 2, 0.286, {1.0, 1.25, 1.5, 2.0, 3.0, 4.0}).with_links, 0.13);
    EXPECT_LT(wrong_beside(foot, 2, 0.286, {1.0}, {0.0}).with_links, 0.09);
    EXPECT_LT(wrong_beside(foot, 2, 0.286, {2.0}).with_links, 0.065);
    EXPECT_LT(wrong_beside(foot, 2, 0.286, {3.0, 4.0}).with_links, 0.02);
  }
  EXPECT_GT(wrong_beside({7, 7}, 2, 0.286, {1.0}).without, 0.2);
}

TEST(TwoForces, DoSoInCubicElementsAndMaterialsOfAllKinds) {
  EXPECT_LT(wrong_beside({7, 7}, 3, 0.286, {1.0, 1.5, 2.0}).with_links, 0.13);
  EXPECT_LT(wrong_beside({7.5, 7.5}, 3, 0.286, {1.0, 1.5, 2.0}).with_links, 0.13);
  for (const double nu : {0.0, 0.45})
    for (const Parameter<2>& foot : {Parameter<2>{7, 7}, {7.2, 7.35}})
      EXPECT_LT(wrong_beside(foot, 2, nu, {1.0, 1.5, 2.0}).with_links, 0.13) << nu;
}

}  // namespace
