// SPDX-License-Identifier: GPL-2.0-or-later
// Sets of nodes, and a probe, which is nodes with weights.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models.h"
#include "structure/conditions/node_set.h"
#include "structure/conditions/probe.h"

namespace {

using models::Vector3;
using nurbs::Face;
using structure::nodes_on;
using structure::nodes_within;
using structure::NodeSet;

// 3 x 4 x 5 control points, the first direction fastest.
const nurbs::Volume kBlock = models::block({1, 2, 3}, {1, 2, 3}, 2);

NodeSet where(double low, double high, int direction) {
  Vector3 from(-9, -9, -9), to(9, 9, 9);
  from[direction] = low;
  to[direction] = high;
  return nodes_within(kBlock.control_points, from, to);
}

TEST(NodeSet, OfAFaceAreThoseInItsPlane) {
  EXPECT_EQ(nodes_on(kBlock.space, {Face::xi_minus}), where(0, 0, 0));
  EXPECT_EQ(nodes_on(kBlock.space, {Face::eta_plus}), where(2, 2, 1));
  EXPECT_EQ(nodes_on(kBlock.space, {Face::zeta_plus}), where(3, 3, 2));
  EXPECT_EQ(nodes_on(kBlock.space, {Face::zeta_plus}).size(), 12u);
}

TEST(NodeSet, OfTwoFacesIsAnEdgeAndOfThreeACorner) {
  EXPECT_EQ(nodes_on(kBlock.space, {Face::xi_plus, Face::eta_minus}),
            nodes_within(kBlock.control_points, {1, 0, -9}, {1, 0, 9}));
  EXPECT_EQ(nodes_on(kBlock.space, {Face::xi_plus, Face::eta_minus}).size(), 5u);
  EXPECT_THAT(nodes_on(kBlock.space, {Face::xi_plus, Face::eta_plus, Face::zeta_plus}),
              testing::ElementsAre(3 * 4 * 5 - 1));
  EXPECT_THAT(nodes_on(kBlock.space, {Face::xi_plus, Face::xi_minus}), testing::IsEmpty());
}

TEST(NodeSet, OfABoxHasItsBorders) {
  EXPECT_EQ(nodes_within(kBlock.control_points, {0, 0, 0}, {1, 2, 3}).size(), 60u);
  EXPECT_THAT(nodes_within(kBlock.control_points, {0, 0, 0}, {0.1, 0.1, 0.1}), testing::ElementsAre(0));
  EXPECT_THAT(nodes_within(kBlock.control_points, {5, 0, 0}, {6, 2, 3}), testing::IsEmpty());
}

TEST(Probe, GivesTheFieldAtItsPoint) {
  const nurbs::Volume ring = models::quarter_ring(2, 3);
  const models::NodalVectors q = models::random_vectors(ring.space.control_point_count(), 3);
  const nurbs::Parameter<3> xi{0.3, 0.8, 0.5};
  const structure::Probe probe = structure::probe_at("there", ring.space, xi);
  EXPECT_EQ(probe.name, "there");
  EXPECT_EQ(probe.value(q), nurbs::interpolate(ring.space, q, xi)) << "to the last bit";
}

}  // namespace
