// SPDX-License-Identifier: GPL-2.0-or-later
// Force distribution and velocity interpolation are one transposed pair.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <stdexcept>

#include "coupling/force_distribution.h"
#include "wavy_surface.h"

namespace {

using coupling::FootBasis;
using coupling::NodalVectors;
using coupling::SurfaceMap;
using coupling::Vector3;

const nurbs::Parameter<2> kFeet[] = {{0.0, 0.0},   {1.0, 1.0},     {0.2, 0.3},
                                     {0.37, 0.81}, {0.999, 0.001}, {0.55, 0.7}};

TEST(ForceDistribution, ControlNodeForcesSumToTheForce) {
  const nurbs::Surface surface = test::wavy_surface();
  const Vector3 F(1.3, -0.2, 7.1);
  for (const auto& xi : kFeet) {
    NodalVectors f = NodalVectors::Zero(3, surface.control_points.cols());
    FootBasis(surface.space, xi).distribute(F, f);
    EXPECT_LE((f.rowwise().sum() - F).norm(), 1e-13 * F.norm());
  }
}

TEST(ForceDistribution, MomentIsThatOfTheForceAtItsFoot) {
  const nurbs::Surface surface = test::wavy_surface();
  const Vector3 F(1.3, -0.2, 7.1);
  for (const auto& xi : kFeet) {
    NodalVectors f = NodalVectors::Zero(3, surface.control_points.cols());
    FootBasis(surface.space, xi).distribute(F, f);
    Vector3 moment = Vector3::Zero();
    for (int a = 0; a < f.cols(); ++a)
      moment += Vector3(surface.control_points.col(a)).cross(Vector3(f.col(a)));
    const Vector3 foot = nurbs::interpolate<2>(surface.space, surface.control_points, xi);
    EXPECT_LE((moment - foot.cross(F)).norm(), 1e-13 * F.norm());
  }
}

TEST(ForceDistribution, PowerIsTheSameOnBothSides) {
  const nurbs::Surface surface = test::wavy_surface();
  const Vector3 F(1.3, -0.2, 7.1);
  std::srand(7);
  for (const auto& xi : kFeet) {
    const NodalVectors v = NodalVectors::Random(3, surface.control_points.cols());
    const FootBasis foot(surface.space, xi);
    NodalVectors f = NodalVectors::Zero(3, v.cols());
    foot.distribute(F, f);
    EXPECT_NEAR(f.cwiseProduct(v).sum(), F.dot(foot.interpolate(v)), 1e-13 * F.norm());
  }
}

TEST(SurfaceMap, TransposedPairForAnyMatrix) {
  std::srand(11);
  const Eigen::MatrixXd dense = Eigen::MatrixXd::Random(5, 8);
  const SurfaceMap map(SurfaceMap::Matrix(dense.sparseView()));
  const NodalVectors x = NodalVectors::Random(3, 8), f = NodalVectors::Random(3, 5);
  NodalVectors on_surface, on_nodes = NodalVectors::Zero(3, 8);
  map.to_surface(x, on_surface);
  map.add_to_nodes(f, on_nodes);
  EXPECT_LE((on_surface - x * dense.transpose()).norm(), 1e-14 * x.norm());
  EXPECT_NEAR(on_surface.cwiseProduct(f).sum(), x.cwiseProduct(on_nodes).sum(), 1e-13);
}

TEST(SurfaceMap, SelectionPicksNodesAndAddsForces) {
  const SurfaceMap map = SurfaceMap::selection({4, 0, 2}, 6);
  NodalVectors x(3, 6), picked;
  for (int a = 0; a < 6; ++a) x.col(a).setConstant(a);
  map.to_surface(x, picked);
  EXPECT_EQ(picked(0, 0), 4.0);
  EXPECT_EQ(picked(1, 1), 0.0);
  EXPECT_EQ(picked(2, 2), 2.0);
  map.add_to_nodes(picked, x);
  EXPECT_EQ(x(0, 4), 8.0);
  EXPECT_EQ(x(0, 5), 5.0);
}

TEST(SurfaceMap, OnTheNodesOfARankIsTheSameMap) {
  constexpr coupling::NodeId kFar = coupling::NodeId(1) << 40;
  const SurfaceMap map = SurfaceMap::selection({kFar + 4, 7, kFar + 2}, 2 * kFar);
  const SurfaceMap held = map.on({3, 7, kFar + 2, kFar + 4});
  EXPECT_EQ(held.node_count(), 4);
  NodalVectors x(3, 4), picked, f = NodalVectors::Zero(3, 4);
  x.row(0) << 30, 70, 20, 40;
  held.to_surface(x, picked);
  EXPECT_EQ(Vector3(picked.row(0)), Vector3(40, 70, 20));
  held.add_to_nodes(picked, f);
  EXPECT_EQ(Eigen::RowVector4d(f.row(0)), Eigen::RowVector4d(0, 70, 20, 40));
  EXPECT_THROW(map.on({3, kFar + 2, kFar + 4}), std::invalid_argument) << "node 7 is missing";
}

}  // namespace
