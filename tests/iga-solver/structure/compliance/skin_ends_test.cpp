// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances where a half-space is no likeness of the body: where its skin ends, beside a wall that
// stands on it, and in a bore, whose other side is straight above the foot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "nurbs/primitives.h"
#include "point_force.h"
#include "structure/compliance/compliance_tables.h"
#include "top.h"

namespace {

using namespace point_force;
using nurbs::KnotVector;
using structure::ComplianceTable;
using structure::ComplianceTables;

constexpr double kPlaneModulus = 1.0 / (1.0 - kNu * kNu);

double normal_compliance(const ReferenceBody& body, const nurbs::Parameter<2>& xi,
                         const structure::SkinPiece& piece = kTop[0]) {
  const structure::FaceSurface surface(body, piece);
  const int element = surface.space().element_at(xi);
  ComplianceTables tables(body, {piece});
  const Vector3 n = surface.at(element, xi).outward_normal;
  const double c = n.dot(tables.direct(0, element, xi) * n);
  const double of_table = top::value(tables, surface.space(), 0, element, xi, ComplianceTable::normal).c;
  EXPECT_NEAR(of_table, c, 0.03 * c) << xi[0] << ' ' << xi[1];
  return c;
}

double spread(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end()) - *std::min_element(values.begin(), values.end());
}

TEST(ComplianceAtEnds, IsThatOfAQuarterOfAnElementAwayFromThem) {
  for (const int degree : {2, 3}) {
    const ReferenceBody body = block_body({6, 6, 4}, {6, 6, 4}, degree);
    ComplianceTables tables(body, kTop);
    const auto c = [&](double x, double y) { return tables.direct(0, 0, {x / 6, y / 6})(2, 2); };
    EXPECT_EQ(c(0.0, 0.5), c(0.25, 0.5));
    EXPECT_EQ(c(0.1, 0.0), c(0.25, 0.25));
    EXPECT_LT(kPlaneModulus * c(0.0, 0.0), 2.1);  // 16 and 29 if the mesh gives way at its very corner
  }
}

/// A floor 6 long, 6 wide and 4 thick with a wall of the same kind on its end, one patch that turns at a C0
/// knot; parameters of the top are its length, from the floor's end to the wall's, and 0 to 1.
ReferenceBody floor_and_wall(int degree, int finer) {
  const int n = 6 * finer;
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < 2 * n; ++i) knots.insert(knots.end(), i == n ? degree : 1, 6.0 * i / n);
  knots.insert(knots.end(), degree + 1, 12.0);
  Volume body = nurbs::box(
      Vector3::Zero(), {12, 6, 4},
      {KnotVector(degree, knots), KnotVector::uniform(degree, n), KnotVector::uniform(degree, 4 * finer)});
  for (auto X : body.control_points.colwise()) {
    const double s = X[0], depth = 4 - X[2];
    X[0] = s <= 6 ? s - 6 + depth * s / 6 : depth;
    X[2] = s <= 6 ? -depth : s - 6 - depth * (12 - s) / 6;
  }
  return body_of(body);
}

// What is left of the mesh's answer, the body's own give, does not depend on the mesh; a quarter of an
// element from the wall a tenth of c may be missing.
TEST(ComplianceAtEnds, BesideAWallLeavesTheBodyWhatIsItsOwn) {
  const auto is_held = [](const Vector3& X) { return X[2] < -4 + 1e-9 || X[0] > 4 - 1e-9; };
  const auto left = [&](int degree, int finer, double distance) {
    const ReferenceBody body = floor_and_wall(degree, finer);
    const nurbs::Parameter<2> xi = {6 - distance, 0.5};
    const double c = normal_compliance(body, xi);
    EXPECT_GT(kPlaneModulus * c / finer, 0.75);
    EXPECT_LT(kPlaneModulus * c / finer, 1.4);
    return kPlaneModulus * (mesh_compliance(body, xi, is_held) - c);
  };
  for (const auto& [distance, tolerance] : {std::pair{1.0, 0.02}, {0.5, 0.02}, {0.25, 0.08}}) {
    const std::vector<double> all = {left(2, 1, distance), left(2, 2, distance), left(3, 1, distance)};
    EXPECT_LT(spread(all), tolerance) << distance << ": " << testing::PrintToString(all);
  }
  const ReferenceBody body = floor_and_wall(2, 1);
  EXPECT_EQ(normal_compliance(body, {6.0 - 1e-9, 0.5}), normal_compliance(body, {5.75, 0.5}));
}

// Three quarters of a tube, held at its ends: the patch of an element goes round to the other side.
TEST(ComplianceAtEnds, InABoreLeavesTheBodyWhatIsItsOwn) {
  const structure::SkinPiece bore = {0, nurbs::Face::zeta_minus};
  const nurbs::Frame frame = nurbs::frame(Vector3::Zero(), Vector3::UnitZ());
  const auto is_held = [](const Vector3& X) { return std::min(X[2], 6 - X[2]) < 1e-9; };
  const auto tube = [&](int around, int finer) {
    const nurbs::Curve round = nurbs::refined(nurbs::arc(0, 270), around * finer, 2);
    return body_of(nurbs::tube(frame, 3, 5, 6, round,
                               {KnotVector::uniform(2, 3 * finer), KnotVector::uniform(2, finer)}));
  };
  for (const double y : {0.5, 1.0 / 3}) {
    std::vector<double> left;
    for (const int finer : {1, 2, 3}) {
      const ReferenceBody body = tube(6, finer);
      const double c = normal_compliance(body, {0.5, y}, bore);
      left.push_back(kPlaneModulus * (mesh_compliance(body, {0.5, y}, is_held, bore) - c));
    }
    EXPECT_LT(spread(left), 0.07) << testing::PrintToString(left);  // c is 0.5 with elements of 45 degrees
    EXPECT_NEAR(left[1], left[2], 0.015);
  }
}

}  // namespace
