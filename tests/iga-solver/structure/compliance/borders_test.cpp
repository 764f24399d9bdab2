// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances where one element ends and the next begins.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models.h"
#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "point_force.h"
#include "structure/compliance/compliance_tables.h"
#include "structure/weld.h"
#include "top.h"

namespace {

using namespace point_force;
using models::Matrix3;
using nurbs::KnotVector;
using testing::HasSubstr;
using testing::ThrowsMessage;
using top::ComplianceTable;
using top::ComplianceTables;
using top::Top;

/// Largest change of a table's component over borders of elements of piece 0, of itself.
double largest_jump(ComplianceTables& tables, const nurbs::Space<2>& space,
                    ComplianceTable::Component component) {
  const auto at = [&](const nurbs::Indices<2>& span, const nurbs::Parameter<2>& xi) {
    return top::value(tables, space, 0, space.element_index(span), xi, component).c;
  };
  double largest = 0.0;
  for (int d = 0; d < 2; ++d)
    for (int i = 1; i < space.knots(d).element_count(); ++i)
      for (int j = 0; j < space.knots(1 - d).element_count(); ++j)
        for (const double way : {0.0, 0.1, 0.3, 0.5, 0.9}) {
          const std::vector<double>& along = space.knots(1 - d).breaks();
          nurbs::Parameter<2> xi;
          xi[d] = space.knots(d).breaks()[i];
          xi[1 - d] = (1.0 - way) * along[j] + way * along[j + 1];
          nurbs::Indices<2> before, after;
          before[d] = i - 1, after[d] = i, before[1 - d] = after[1 - d] = j;
          const double c = at(before, xi);
          largest = std::max(largest, std::abs(at(after, xi) / c - 1.0));
        }
  return largest;
}

// Else a ball that rolls over one is given energy, or loses it: 0.5 % of c here, 14 % if they are flat.
TEST(ComplianceAtBorders, DoesNotJumpOverBordersOfElements) {
  struct Case {
    ReferenceBody body;
    nurbs::Face face;
  };
  const Case cases[] = {
      {body_of(models::distorted(models::block({7, 7, 4}, {7, 7, 4}, 2), 0.2)), nurbs::Face::zeta_plus},
      {block_body({5, 5, 3}, {5, 5, 3}, 3), nurbs::Face::zeta_plus},
      {block_body({24, 24, 1}, {8, 8, 1}, 2), nurbs::Face::zeta_plus},
      {body_of(models::quarter_ring(2, 6)), nurbs::Face::xi_plus}};
  for (const Case& of : cases) {
    const nurbs::Space<2> space = nurbs::boundary_surface(of.body.patches[0].space, of.face).space;
    ComplianceTables tables(of.body, {{0, of.face}});
    for (const auto component : {ComplianceTable::normal, ComplianceTable::first, ComplianceTable::second})
      EXPECT_LT(largest_jump(tables, space, component), 1e-11);
  }
}

// What the means change on the sides of an element they change inside, bilinearly in between.
TEST(ComplianceAtBorders, OfTheMiddleChangesAsThatOfTheSides) {
  const Top top{block_body({7, 7, 4}, {7, 7, 4}, 2)};
  ComplianceTables tables(top.body, kTop);
  const int element = 1 + 7 * 2;
  const nurbs::Parameter<2> low = {1.0 / 7, 2.0 / 7}, high = {2.0 / 7, 3.0 / 7};
  const auto change = [&](double s, double t) {
    const nurbs::Parameter<2> xi = {low[0] + s * (high[0] - low[0]), low[1] + t * (high[1] - low[1])};
    return top::value(tables, top.space, 0, element, xi, ComplianceTable::normal).c -
           tables.direct(0, element, xi)(2, 2);
  };
  const double sides = change(0.5, 0.0) + change(0.5, 1.0) + change(0.0, 0.5) + change(1.0, 0.5),
               corners = change(0.0, 0.0) + change(1.0, 0.0) + change(0.0, 1.0) + change(1.0, 1.0);
  EXPECT_GT(std::abs(sides), 1e-4);
  EXPECT_NEAR(change(0.5, 0.5), 0.5 * sides - 0.25 * corners, 1e-12);
}

/// What the table of an element of the body's `p`th piece has at a point, in space.
Matrix3 tensor_at(ComplianceTables& tables, const ReferenceBody& body, const structure::SkinPiece& piece,
                  int p, int element, const nurbs::Parameter<2>& xi) {
  const structure::FaceSurface surface(body, piece);
  const auto c = [&](ComplianceTable::Component component) {
    return top::value(tables, surface.space(), p, element, xi, component).c;
  };
  Matrix3 in_frame;
  in_frame << c(ComplianceTable::first), c(ComplianceTable::first_second),
      c(ComplianceTable::first_normal),                                                                 //
      c(ComplianceTable::first_second), c(ComplianceTable::second), c(ComplianceTable::second_normal),  //
      c(ComplianceTable::first_normal), c(ComplianceTable::second_normal), c(ComplianceTable::normal);
  const Matrix3 frame = surface.frame(element, xi);
  return frame * in_frame * frame.transpose();
}

// The second patch has its directions the other way round: its first is the first one's second, downwards.
TEST(ComplianceAtBorders, DoesNotJumpOverWelds) {
  const Vector3 size(5, 6, 4);
  const Volume first =
      nurbs::box(Vector3::Zero(), size,
                 {KnotVector::uniform(2, 5), KnotVector::uniform(2, 6), KnotVector::uniform(2, 4)});
  Volume second =
      nurbs::box(Vector3::Zero(), {6, 5, 4},
                 {KnotVector::uniform(2, 6), KnotVector::uniform(2, 5), KnotVector::uniform(2, 4)});
  for (auto X : second.control_points.colwise()) X = Vector3(5 + X[1], 6 - X[0], X[2]).eval();
  const std::vector<Volume> patches = {first, second};
  const ReferenceBody body{
      patches, {models::elastic(1.0, kNu), models::elastic(1.0, kNu)}, structure::weld(patches)};
  const std::vector<structure::SkinPiece> skin = {{0, nurbs::Face::zeta_plus}, {1, nurbs::Face::zeta_plus}};
  ComplianceTables tables(body, skin);
  for (const double y : {0.5, 1.0, 2.25, 3.8}) {
    const int row = static_cast<int>(y);
    const Matrix3 left = tensor_at(tables, body, skin[0], 0, 4 + 5 * row, {1.0, y / 6}),
                  right = tensor_at(tables, body, skin[1], 1, 5 - row, {1.0 - y / 6, 0.0});
    EXPECT_LT((left - right).norm(), 1e-11 * left.norm()) << y;
    const double direct = tables.direct(0, 4 + 5 * row, {1.0, y / 6})(2, 2);
    EXPECT_NEAR(left(2, 2), direct, 0.01 * direct);
  }
}

// Elements of the top are half as long as those of the side.  The end's are not touched.
TEST(ComplianceAtBorders, DoesNotJumpOverAConvexEdge) {
  const ReferenceBody body = block_body({5, 6, 4}, {10, 6, 4}, 2);
  const std::vector<structure::SkinPiece> skin = {{0, nurbs::Face::zeta_plus}, {0, nurbs::Face::xi_plus}};
  const structure::FaceSurface top(body, skin[0]), side(body, skin[1]);
  ComplianceTables tables(body, skin), of_top(body, {skin[0]});
  for (const double y : {0.5, 1.0, 2.25, 3.8}) {
    const int row = static_cast<int>(y);
    const auto c = [&](ComplianceTables& of, int p, ComplianceTable::Component component) {
      return p == 0 ? top::value(of, top.space(), 0, 9 + 10 * row, {1.0, y / 6}, component).c
                    : top::value(of, side.space(), 1, row + 6 * 3, {y / 6, 1.0}, component).c;
    };
    const double normal = c(tables, 0, ComplianceTable::normal);
    EXPECT_NEAR(c(tables, 1, ComplianceTable::normal), normal, 1e-11 * normal) << y;
    EXPECT_GT(std::abs(c(of_top, 0, ComplianceTable::normal) / normal - 1.0), 0.05);
    // along the edge, which is the second direction of the top and the first of the side
    const double along = c(tables, 0, ComplianceTable::second);
    EXPECT_NEAR(c(tables, 1, ComplianceTable::first), along, 1e-11 * along) << y;
  }
}

// There contacts end: each of the two surfaces has its own.
TEST(ComplianceAtBorders, AtAConcaveEdgeIsEachSidesOwn) {
  Volume angle = nurbs::box(Vector3::Zero(), {12, 4, 3},
                            {KnotVector(2, {0, 0, 0, 1, 2, 3, 3, 4, 6, 6, 6}), KnotVector::uniform(2, 4),
                             KnotVector::uniform(2, 3)});
  for (auto X : angle.control_points.colwise()) {
    const double s = X[0], depth = 3 - X[2];
    X[0] = s <= 6 ? s - 6 + depth * s / 6 : depth;
    X[2] = s <= 6 ? -depth : s - 6 - depth * (12 - s) / 6;
  }
  const Top top{body_of(angle)};
  ComplianceTables tables(top.body, kTop);
  const double corner = top.space.knots(0).breaks()[3];
  for (const int element : {2, 3}) {
    const nurbs::Parameter<2> xi = {corner, 0.375};  // the middle of a side
    const structure::FaceSurface surface(top.body, kTop[0]);
    const Vector3 n = surface.frame(element + 5, xi).col(2);
    const double c = n.dot(tables.direct(0, element + 5, xi) * n);
    EXPECT_NEAR(top::value(tables, top.space, 0, element + 5, xi, ComplianceTable::normal).c, c, 1e-11 * c);
  }
}

// About the axis of a cylinder that is a tube without a bore there is no normal; beside it there is.
TEST(ComplianceAtBorders, BesideAnElementWithoutNormalIsThatElementsOwn) {
  const nurbs::Frame frame = nurbs::frame(Vector3::Zero(), Vector3::UnitZ());
  const nurbs::Curve round = nurbs::refined(nurbs::arc(0, 90), 4, 2);
  Volume solid = nurbs::tube(frame, 1, 6, 4, round, {KnotVector::uniform(2, 4), KnotVector::uniform(2, 6)});
  for (auto X : solid.control_points.colwise())
    if (X.head<2>().norm() < 1.2) X.head<2>().setZero();
  const ReferenceBody body = body_of(solid);
  const structure::SkinPiece end = {0, nurbs::Face::eta_minus};
  const structure::FaceSurface surface(body, end);
  ComplianceTables tables(body, {end});
  EXPECT_THAT([&] { tables.of(0, 1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("no normal")));
  const int element = 5;  // the second from the axis, its first side is the border
  const nurbs::Parameter<2> centre = surface.space().element_centre(element),
                            border = {centre[0], surface.space().knots(1).breaks()[1]};
  EXPECT_NEAR(top::value(tables, surface.space(), 0, element, border, ComplianceTable::normal).c,
              tables.direct(0, element, border)(2, 2), 1e-12);
}

}  // namespace
