// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances where one element ends and the next begins.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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

/// Largest changes of a table's component over borders of elements of piece 0, of itself: of the value, and
/// of the slope across, for which an element's length counts as one; that one not beside ends of the skin.
struct Jumps {
  double value = 0.0, slope = 0.0;
};
Jumps largest_jumps(ComplianceTables& tables, const nurbs::Space<2>& space,
                    ComplianceTable::Component component) {
  const auto at = [&](const nurbs::Indices<2>& span, const nurbs::Parameter<2>& xi) {
    return top::value(tables, space, 0, space.element_index(span), xi, component);
  };
  Jumps largest;
  for (int d = 0; d < 2; ++d)
    for (int i = 1; i < space.knots(d).element_count(); ++i)
      for (int j = 0; j < space.knots(1 - d).element_count(); ++j)
        for (const double way : {0.0, 0.01, 0.1, 0.3, 0.5, 0.9, 0.98}) {
          const std::vector<double>&along = space.knots(1 - d).breaks(), &across = space.knots(d).breaks();
          const int last = space.knots(1 - d).element_count() - 1;
          nurbs::Parameter<2> xi;
          xi[d] = across[i];
          xi[1 - d] = (1.0 - way) * along[j] + way * along[j + 1];
          nurbs::Indices<2> before, after;
          before[d] = i - 1, after[d] = i, before[1 - d] = after[1 - d] = j;
          const ComplianceTable::Value a = at(before, xi), b = at(after, xi);
          largest.value = std::max(largest.value, std::abs(b.c / a.c - 1.0));
          const double length = across[i] - across[i - 1];
          const bool is_at_end = (j == 0 && way < 0.1) || (j == last && way > 0.9);
          if (!is_at_end)
            largest.slope = std::max(largest.slope, std::abs((b.change[d] - a.change[d]) * length / a.c));
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
      EXPECT_LT(largest_jumps(tables, space, component).value, 1e-11);
  }
}

// Else a ball that stands on one is rocked: 9e-3 of an impact's energy on quadratic elements of 1.3 contact
// radii.  Slopes jump by 2.5 % of c here, on flat elements by much more.
TEST(ComplianceAtBorders, HasSlopesThatGoOnOverBordersOfElements) {
  for (const ReferenceBody& body :
       {block_body({7, 7, 4}, {7, 7, 4}, 2), block_body({5, 5, 3}, {5, 5, 3}, 3),
        block_body({24, 24, 1}, {8, 8, 1}, 2),
        body_of(nurbs::box(Vector3::Zero(), {7, 6, 4},
                           {KnotVector(2, {0, 0, 0, 1, 2.5, 3, 4.2, 5, 5, 5}), KnotVector::uniform(2, 6),
                            KnotVector::uniform(2, 4)})),
        body_of(nurbs::box(Vector3::Zero(), {6, 6, 4},  // with a C0 knot
                           {KnotVector(2, {0, 0, 0, 1, 2, 3, 3, 4.5, 5, 6, 6, 6}), KnotVector::uniform(2, 6),
                            KnotVector::uniform(2, 4)}))}) {
    const nurbs::Space<2> space =
        nurbs::boundary_surface(body.patches[0].space, nurbs::Face::zeta_plus).space;
    ComplianceTables tables(body, kTop);
    for (const auto component : {ComplianceTable::normal, ComplianceTable::first, ComplianceTable::second})
      EXPECT_LT(largest_jumps(tables, space, component).slope, 1e-10);
  }
  const ReferenceBody ring = body_of(models::quarter_ring(2, 6));
  ComplianceTables tables(ring, {{0, nurbs::Face::xi_plus}});
  const nurbs::Space<2> space = nurbs::boundary_surface(ring.patches[0].space, nurbs::Face::xi_plus).space;
  EXPECT_LT(largest_jumps(tables, space, ComplianceTable::normal).slope, 1e-3);
}

// What the means change on the sides of an element they change inside, bilinearly in between.
TEST(ComplianceAtBorders, OfTheMiddleChangesAsThatOfTheSides) {
  const Top top{block_body({7, 7, 4}, {7, 7, 4}, 2)};
  ComplianceTables tables(top.body, kTop);
  const int column = 1, row = 2;
  const auto direct = [&](int i, int j, double s, double t) {
    return tables.direct(0, column + i + 7 * (row + j), {(column + s) / 7, (row + t) / 7})(2, 2);
  };
  // To that of the element itself; a step sideways where the place is on a side.
  const auto change = [&](double s, double t) {
    const int i = s == 0.5 ? 0 : s < 0.5 ? -1 : 1, j = t == 0.5 ? 0 : t < 0.5 ? -1 : 1;
    const double mean =
        0.25 * (direct(0, 0, s, t) + direct(i, 0, s, t) + direct(0, j, s, t) + direct(i, j, s, t));
    return mean - direct(0, 0, s, t);
  };
  const double sides = change(0.5, 0.0) + change(0.5, 1.0) + change(0.0, 0.5) + change(1.0, 0.5),
               corners = change(0.0, 0.0) + change(1.0, 0.0) + change(0.0, 1.0) + change(1.0, 1.0);
  EXPECT_GT(std::abs(sides), 1e-4);
  const double middle = top.table(tables, {(column + 0.5) / 7, (row + 0.5) / 7});
  EXPECT_NEAR(middle - direct(0, 0, 0.5, 0.5), 0.5 * sides - 0.25 * corners, 1e-12);
}

// Beside borders, where strips take up what is left of a kink, as inside, the skin's ends and C0 knots
// included: there borders end that are rounded.
TEST(ComplianceAtBorders, HasTheSlopesThatItSays) {
  const double w = 0.5 * structure::kStripWidth;
  const ReferenceBody body = body_of(nurbs::box(Vector3::Zero(), {6, 6, 4},
                                                {KnotVector(2, {0, 0, 0, 1, 2, 3, 3, 4.5, 5, 6, 6, 6}),
                                                 KnotVector::uniform(2, 6), KnotVector::uniform(2, 4)}));
  const Top top{body};
  ComplianceTables tables(body, kTop);
  for (const int element : {0, 7, 8, 9, 15})
    for (const double s : {1e-4, 0.3 * w, 0.7 * w, 0.999 * w, 1.001 * w, 0.4, 1 - 0.4 * w})
      for (const double t : {1e-4, 0.5 * w, 0.999 * w, 1.001 * w, 0.7, 1 - 0.8 * w}) {
        const nurbs::Indices<2> span = top.space.element_indices(element);
        nurbs::Parameter<2> xi, length;
        for (int d = 0; d < 2; ++d) {
          const std::vector<double>& breaks = top.space.knots(d).breaks();
          length[d] = breaks[span[d] + 1] - breaks[span[d]];
          xi[d] = breaks[span[d]] + (d == 0 ? s : t) * length[d];
        }
        for (const auto component : {ComplianceTable::normal, ComplianceTable::first_normal}) {
          const auto at = [&](const nurbs::Parameter<2>& place) {
            return top::value(tables, top.space, 0, element, place, component);
          };
          for (int d = 0; d < 2; ++d) {
            const double step = 1e-6 * length[d];
            nurbs::Parameter<2> before = xi, after = xi;
            before[d] -= step, after[d] += step;
            const double found = (at(after).c - at(before).c) / (2 * step);
            EXPECT_NEAR(at(xi).change[d] * length[d], found * length[d], 2e-8)
                << element << ' ' << s << ' ' << t;
          }
        }
      }
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

// Each of the three patches has two of the three borders, whose strips fade out there.
TEST(ComplianceAtBorders, DoesNotJumpWhereThreePatchesMeet) {
  constexpr int kRow = 4;
  const Vector3 way[] = {{1.0, 0.0, 0.0}, {-0.3, 1.2, 0.0}, {-0.5, -0.6, 0.0}};
  std::vector<Volume> patches;
  std::vector<structure::SkinPiece> skin;
  for (int k = 0; k < 3; ++k) {
    const KnotVector row = KnotVector::uniform(2, kRow), depth = KnotVector::uniform(2, 3);
    Volume rhomb = nurbs::box(Vector3::Zero(), {kRow, kRow, 3}, {row, row, depth});
    for (auto X : rhomb.control_points.colwise())
      X = (X[0] * way[k] + X[1] * way[(k + 1) % 3] + X[2] * Vector3::UnitZ()).eval();
    patches.push_back(rhomb);
    skin.push_back({k, nurbs::Face::zeta_plus});
  }
  const ReferenceBody body{patches, {3, models::elastic(1.0, kNu)}, structure::weld(patches)};
  const nurbs::Space<2> space = nurbs::boundary_surface(patches[0].space, nurbs::Face::zeta_plus).space;
  ComplianceTables tables(body, skin);
  for (const double along : {0.0, 0.005, 0.02, 0.035, 0.5, 0.99}) {
    const double one = top::value(tables, space, 0, 0, {0.0, along / kRow}, ComplianceTable::normal).c,
                 other = top::value(tables, space, 1, 0, {along / kRow, 0.0}, ComplianceTable::normal).c;
    EXPECT_NEAR(one, other, 1e-11 * one) << along;
  }
}

/// How the compliance along the normal changes along the surface, in space, where skin has a normal.
Vector3 slope_at(ComplianceTables& tables, const structure::FaceSurface& surface, int p, int element,
                 const nurbs::Parameter<2>& xi, ComplianceTable::Component component) {
  const std::array<Vector3, 2> tangents = surface.tangents(element, xi);
  const ComplianceTable::Value c = top::value(tables, surface.space(), p, element, xi, component);
  Eigen::Matrix<double, 3, 2> t;
  t << tangents[0], tangents[1];
  return t * (t.transpose() * t).inverse() * Eigen::Vector2d(c.change[0], c.change[1]);
}

// Elements of the second patch, which has its directions the other way round, are longer across the weld, and
// its rows may be askew.
TEST(ComplianceAtBorders, HasSlopesThatGoOnOverWelds) {
  for (const double askew : {0.0, 0.15}) {
    const Volume first =
        nurbs::box(Vector3::Zero(), {5, 6, 4},
                   {KnotVector::uniform(2, 5), KnotVector::uniform(2, 6), KnotVector::uniform(2, 4)});
    Volume second =
        nurbs::box(Vector3::Zero(), {6, 5, 4},
                   {KnotVector::uniform(2, 6), KnotVector::uniform(2, 4), KnotVector::uniform(2, 4)});
    for (auto X : second.control_points.colwise())
      X = Vector3(5 + X[1], 6 - X[0] - askew * X[1] * X[0] * (6 - X[0]) / 9, X[2]).eval();
    const std::vector<Volume> patches = {first, second};
    const ReferenceBody body{
        patches, {models::elastic(1.0, kNu), models::elastic(1.0, kNu)}, structure::weld(patches)};
    const std::vector<structure::SkinPiece> skin = {{0, nurbs::Face::zeta_plus}, {1, nurbs::Face::zeta_plus}};
    const structure::FaceSurface left(body, skin[0]), right(body, skin[1]);
    ComplianceTables tables(body, skin);
    // The first patch's t_1 and the second's t_2 are across, but for their turn.
    using Components = std::pair<ComplianceTable::Component, ComplianceTable::Component>;
    std::vector<Components> components = {{ComplianceTable::normal, ComplianceTable::normal}};
    if (askew == 0.0) {
      components.push_back({ComplianceTable::first, ComplianceTable::second});
      components.push_back({ComplianceTable::second, ComplianceTable::first});
    }
    for (const auto& [of_left, of_right] : components)
      for (const double y : {1.2, 2.01, 2.25, 3.0, 3.8}) {
        const int row = static_cast<int>(y);
        const Vector3 a = slope_at(tables, left, 0, 4 + 5 * row, {1.0, y / 6}, of_left),
                      b = slope_at(tables, right, 1, 5 - row, {1.0 - y / 6, 0.0}, of_right);
        // How rows are askew is no polynomial along the border, and left out at corners; without strips 0.1.
        EXPECT_LT((a - b).norm(), askew == 0.0 ? 1e-11 : 2e-3) << y << ' ' << askew;
      }
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
