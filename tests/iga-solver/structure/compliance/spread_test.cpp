// SPDX-License-Identifier: GPL-2.0-or-later
// Forces that are spread over the net about their foot, as far as the pressure of a contact after Hertz: what
// the mesh gives way under them, beyond what a half-space does.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "nurbs/refinement.h"
#include "point_force.h"
#include "structure/compliance/element_compliances.h"
#include "structure/compliance/skin_net.h"

namespace {

using nurbs::NodalVectors;
using nurbs::Parameter;
using nurbs::Vector3;
using point_force::displacements;
using point_force::kTop;
using point_force::unit_force;

structure::ReferenceBody block(const Vector3& size, const std::array<int, 3>& elements, int degree) {
  return point_force::block_body(size, elements, degree);
}

/// Along the normal: Z of a foot.
NodalVectors beside(const structure::ReferenceBody& body, const Parameter<2>& xi) {
  const structure::FaceSurface top(body, kTop[0]);
  const structure::NetMean::Beside beside =
      structure::SkinNet(body, kTop).beside(top.at(top.space().element_at(xi), xi));
  NodalVectors load = NodalVectors::Zero(3, body.patches[0].control_points.cols());
  for (std::size_t a = 0; a < beside.nodes.size(); ++a) load(2, beside.nodes[a]) = beside.Z[a];
  return load;
}

double work(const NodalVectors& a, const NodalVectors& b) { return a.cwiseProduct(b).sum(); }

TEST(NetMean, HasNoForceNoMomentAndTheMomentsOfItsName) {
  for (const int degree : {2, 3}) {
    const structure::ReferenceBody body = block({10, 20, 4}, {10, 10, 4}, degree);
    const NodalVectors Z = beside(body, {0.53, 0.48});
    const NodalVectors& X = body.patches[0].control_points;
    EXPECT_NEAR(Z.row(2).sum(), 0.0, 1e-14);
    EXPECT_NEAR(Z.row(2).dot(X.row(0)), 0.0, 1e-13);
    EXPECT_NEAR(Z.row(2).dot(X.row(1)), 0.0, 1e-13);
    EXPECT_NEAR(Z.row(2).dot(X.row(0).cwiseAbs2()), 0.4, 1e-12);
    EXPECT_NEAR(Z.row(2).dot(X.row(1).cwiseAbs2()), 0.4 * 4.0, 1e-12);
  }
}

TEST(NetMean, HasNoMomentOnAGradedNetEither) {
  structure::ReferenceBody body = block({10, 10, 4}, {10, 10, 4}, 2);
  NodalVectors& X = body.patches[0].control_points;
  X.row(0) = 10.0 * (X.row(0).array() / 10.0).square();
  const NodalVectors Z = beside(body, {0.53, 0.48});
  EXPECT_NEAR(Z.row(2).sum(), 0.0, 1e-14);
  EXPECT_NEAR(Z.row(2).dot(X.row(0)), 0.0, 1e-13);
  EXPECT_GT(Z.row(2).dot(X.row(0).cwiseAbs2()), 0.3);
}

// A face of a cube of two welded patches, seam across the foot: as on one patch; over the cube's edge nothing
// goes.
TEST(NetMean, GoesAcrossWeldsAndNotOverEdges) {
  const nurbs::Volume left = models::block({2, 4, 2}, {2, 4, 2}, 2);
  nurbs::Volume right = left;
  right.control_points.row(0).array() += 2.0;
  const std::vector<nurbs::Volume> patches = {left, right};
  const std::vector<structure::SkinPiece> skin = {
      {0, nurbs::Face::zeta_plus}, {1, nurbs::Face::zeta_plus}, {1, nurbs::Face::xi_plus}};
  const structure::ReferenceBody body{
      patches, {models::elastic(1.0, 0.3), models::elastic(1.0, 0.3)}, structure::weld(patches)};
  const structure::SkinNet net(body, skin);
  int across = 0;
  for (const auto& [from, to, share] : net.mean.shares()) {
    const auto [p, a] = body.nodes.place(from);
    const auto [q, b] = body.nodes.place(to);
    const Vector3 X = patches[p].control_points.col(a), way = patches[q].control_points.col(b) - X;
    const bool at_edge = X[0] > 4.0 - 1e-9 && X[2] > 2.0 - 1e-9;
    EXPECT_FALSE(at_edge && (way[0] != 0.0 || way[2] != 0.0)) << X.transpose();
    across += std::abs(X[0] - 1.5) < 1e-9 && std::abs(way[0] - 1.0) < 1e-9;
    EXPECT_GT(std::abs(X[0] + way[0] - 2.0), 0.4);  // none to the seam, at 2
  }
  EXPECT_EQ(across, 6);
}

// Less what a block gives way more or less than a half-space: a spread force of the same moments about a foot
// on it finds the same, but for how that varies.
TEST(SpreadForces, GiveWayAsOnAWholeBlock) {
  for (const int degree : {2, 3}) {
    const structure::ReferenceBody body = block({14, 14, 6}, {14, 14, 6}, degree);
    const structure::ElementCompliances compliances(body, kTop);
    const auto on_base = [](const Vector3& X) { return X[2] < 1e-9; };
    for (const Parameter<2>& foot : {Parameter<2>{7, 7}, {7.5, 7.5}, {7.25, 7.4}}) {
      const Parameter<2> xi = {foot[0] / 14, foot[1] / 14};
      const NodalVectors R = unit_force(body, xi), Z = beside(body, xi),
                         of_Z = displacements(body, Z, on_base);
      const auto found = compliances.spread_direct(0, 7 + 14 * 7, xi);
      EXPECT_NEAR(found.one(2, 2), work(of_Z, R), 0.02) << degree;
      EXPECT_NEAR(found.both(2, 2), work(of_Z, Z), 0.02) << degree;
      EXPECT_LT(found.one(2, 2), -0.25);
    }
  }
}

// The same where patches are welded, or a knot stands as often as the degree is.
TEST(SpreadForces, GiveWayAtSeamsAsOnAWholeBlock) {
  for (const int degree : {2, 3}) {
    structure::ReferenceBody body = block({14, 14, 6}, {14, 14, 6}, degree);
    body = point_force::body_of(nurbs::insert_knot(body.patches[0], 0, 0.5, degree - 1));
    const structure::ElementCompliances compliances(body, kTop);
    const auto on_base = [](const Vector3& X) { return X[2] < 1e-9; };
    for (const Parameter<2>& foot :
         {Parameter<2>{7, 7}, {7.5, 7.5}, {7.25, 7.4}, {7, 7.5}, {8.25, 7.25}, {9.5, 7.25}, {10.2, 7.5}}) {
      const Parameter<2> xi = {foot[0] / 14, foot[1] / 14};
      const NodalVectors R = unit_force(body, xi), Z = beside(body, xi),
                         of_Z = displacements(body, Z, on_base);
      const int element = static_cast<int>(foot[0]) + 14 * 7;
      const auto found = compliances.spread_direct(0, element, xi);
      EXPECT_NEAR(found.one(2, 2), work(of_Z, R), 0.02) << degree;
      EXPECT_NEAR(found.both(2, 2), work(of_Z, Z), 0.025) << degree;
      EXPECT_LT(found.one(2, 2), -0.2);
    }
  }
}

/// Nodal forces of a unit force with the pressure of a flat punch of this radius, on a square of 12 [length].
NodalVectors punch(const structure::ReferenceBody& body, double radius) {
  constexpr int kRings = 12, kAround = 16;
  NodalVectors load = 0.0 * unit_force(body, {0.5, 0.5});
  for (int i = 0; i < kRings; ++i) {
    const double share = (i + 0.5) / kRings, r = radius * std::sqrt(1.0 - (1.0 - share) * (1.0 - share));
    for (int k = 0; k < kAround; ++k) {
      const double angle = nurbs::kTwoPi * (k + 0.5 * (i % 2)) / kAround;
      load += unit_force(body, {0.5 + r / 12 * std::cos(angle), 0.5 + r / 12 * std::sin(angle)}) /
              (kRings * kAround);
    }
  }
  return load;
}

// A plate as thick as its elements are long: what it does under a spread force, less what the tables have of
// it, is what a plate of four layers does under a punch of the same second moment, less what a half-space
// does there, 1/(2 E' a).  Cubic through the thickness: a layer of quadratic elements shears too little.
TEST(SpreadForces, LeaveAPlateWhatItDoesUnderADisc) {
  const auto on_rim = [](const Vector3& X) {
    return X[0] < 1e-9 || X[1] < 1e-9 || X[0] > 12 - 1e-9 || X[1] > 12 - 1e-9;
  };
  const double E_plane = 1.0 / (1.0 - point_force::kNu * point_force::kNu);
  const structure::ReferenceBody plate = block({12, 12, 1}, {12, 12, 1}, 3),
                                 fine = block({12, 12, 1}, {48, 48, 4}, 2);
  const structure::ElementCompliances compliances(plate, kTop);
  const Parameter<2> xi = {0.5, 0.5};
  const NodalVectors R = unit_force(plate, xi), Z = beside(plate, xi);
  const auto found = compliances.spread_direct(0, 6 + 12 * 6, xi);
  const double c = compliances.direct(0, 6 + 12 * 6, xi)(2, 2);
  for (const double w : {0.4, 0.8}) {
    const NodalVectors load = R + w * Z;
    const double moment =
        Z.row(2).dot((plate.patches[0].control_points.row(0).array() - 6.0).square().matrix());
    const double radius = std::sqrt(3.0 * w * moment);
    const NodalVectors disc = punch(fine, radius);
    const double of_disc = work(disc, displacements(fine, disc, on_rim)) - 1.0 / (2.0 * E_plane * radius);
    const double left = work(load, displacements(plate, load, on_rim)) -
                        (c + 2.0 * w * found.one(2, 2) + w * w * found.both(2, 2));
    EXPECT_NEAR(left, of_disc, 0.05) << w;
  }
}

}  // namespace
