// SPDX-License-Identifier: GPL-2.0-or-later
// Supports, loads and probes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "models.h"
#include "structure/conditions/loads.h"
#include "structure/conditions/probe.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::Solid;

TEST(Supports, FixOneFaceInTheGivenDirectionsOnly) {
  const nurbs::Volume patch = models::block({1, 2, 3}, {2, 2, 2}, 2);
  structure::Supports supports;
  supports.fix(structure::nodes_on(patch.space, {Face::eta_plus}), {true, false, true});
  supports.fix(structure::nodes_on(patch.space, {Face::eta_plus}),
               {false, false, true});  // again: counted once
  EXPECT_EQ(supports.fixed_dofs().size(), 2u * 4 * 4);
  NodalVectors values = NodalVectors::Ones(3, patch.space.control_point_count());
  supports.apply(values);
  for (int A = 0; A < values.cols(); ++A) {
    const bool on_face = patch.control_points(1, A) == 2.0;
    EXPECT_EQ(values.col(A), Vector3(on_face ? 0 : 1, 1, on_face ? 0 : 1));
  }
}

// Constant stress P balances the tractions P n of the six faces, node by node.
TEST(TractionLoad, BalancesTheInternalForceOfConstantStress) {
  const Vector3 size(1, 2, 3);
  const Solid solid(models::block(size, {2, 3, 1}, {2, 3, 1}), models::elastic());
  const structure::Matrix3 H = models::some_gradient(), P = (*solid.materials().front()).stress(H, nullptr);
  NodalVectors f_int(3, solid.node_count()), f_ext = NodalVectors::Zero(3, solid.node_count());
  solid.internal_force(models::linear_field(H, solid.reference()), f_int);
  for (int d = 0; d < 3; ++d) {
    f_ext += structure::traction_load(solid, {0, static_cast<Face>(2 * d)}, -P.col(d));
    f_ext += structure::traction_load(solid, {0, static_cast<Face>(2 * d + 1)}, P.col(d));
  }
  EXPECT_LT((f_int - f_ext).cwiseAbs().maxCoeff(), 1e-13 * P.norm());
}

TEST(TractionLoad, OnACurvedFaceSumsToTractionTimesArea) {
  const Vector3 traction(1, -2, 3);
  const Solid solid(models::quarter_ring(2, 4), models::elastic());
  const Vector3 total = structure::traction_load(solid, {0, Face::xi_plus}, traction).rowwise().sum();
  EXPECT_LT((total - std::acos(-1.0) * traction).norm(), 1e-7);  // radius 2, quarter, height 1
}

// Row sums reproduce the first moment of mass: integral of density x = sum m_A X_A.
TEST(GravityLoad, HasTheForceAndTheMomentOfTheWeightAtTheCentreOfMass) {
  const Solid solid(models::quarter_ring(2, 4), models::elastic(1.0, 0.3, 2.5));
  const double pi = std::acos(-1.0), x = 28.0 / (9.0 * pi);
  const Vector3 g(1, 2, -9.81), weight = 2.5 * 0.75 * pi * g, centre(x, x, 0.5);
  const NodalVectors f = structure::gravity_load(solid, g);
  Vector3 moment = Vector3::Zero();
  for (int A = 0; A < f.cols(); ++A) moment += Vector3(solid.reference().col(A)).cross(Vector3(f.col(A)));
  EXPECT_LT((f.rowwise().sum() - weight).norm(), 1e-7 * weight.norm());
  EXPECT_LT((moment - centre.cross(weight)).norm(), 1e-7 * weight.norm());
}

TEST(FacePoint, LiesOnTheFaceAtTheRelativeParameters) {
  const nurbs::Volume patch = models::block({1, 2, 3}, {3, 2, 2}, 2);
  const auto at = [&](Face face, double u, double v) {
    return nurbs::interpolate(patch.space, patch.control_points,
                              structure::face_point(patch.space, face, {u, v}));
  };
  EXPECT_LT((at(Face::xi_plus, 0.25, 0.5) - Vector3(1, 0.5, 1.5)).norm(), 1e-14);
  EXPECT_LT((at(Face::eta_minus, 0.25, 0.5) - Vector3(0.25, 0, 1.5)).norm(), 1e-14);
  EXPECT_LT((at(Face::zeta_plus, 0.25, 1.0) - Vector3(0.25, 2, 3)).norm(), 1e-14);
  EXPECT_THROW(at(Face::zeta_plus, 1.1, 0.0), std::invalid_argument);
  EXPECT_THROW(at(Face::zeta_plus, 0.0, -0.1), std::invalid_argument);
}

// Relative parameters, whatever the knots.
TEST(FacePoint, IsRelativeToTheKnots) {
  const nurbs::KnotVector u = nurbs::KnotVector::uniform(2, 3, 2.0, 5.0),
                          v = nurbs::KnotVector::uniform(1, 2, -4.0, -2.0),
                          w = nurbs::KnotVector::uniform(2, 1, 0.0, 10.0);
  const nurbs::Parameter<3> low =
      structure::face_point(nurbs::Space<3>({u, v, w}), Face::eta_minus, {0.5, 0.25});
  const nurbs::Parameter<3> high =
      structure::face_point(nurbs::Space<3>({u, v, w}), Face::eta_plus, {0.0, 1.0});
  EXPECT_EQ(low, (nurbs::Parameter<3>{3.5, -4.0, 2.5}));
  EXPECT_EQ(high, (nurbs::Parameter<3>{2.0, -2.0, 10.0}));
}

}  // namespace
