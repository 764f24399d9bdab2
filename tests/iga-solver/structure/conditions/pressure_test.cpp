// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on the skin, along edges, at points and in the volume: sums, moments, and what a pressure does to a
// deformed body.
#include "structure/conditions/pressure.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "models.h"
#include "structure/conditions/loads.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using nurbs::Face;
using structure::Id;
using structure::Solid;

nurbs::Volume whole_patch(const Solid& solid) { return {solid.space(), solid.reference()}; }

std::vector<Id> ids(const Solid& solid) {
  std::vector<Id> all(solid.node_count());
  std::iota(all.begin(), all.end(), Id(0));
  return all;
}

structure::Field pressure_of(double p) {
  return [=](const Vector3&, double) { return Vector3(p, 0, 0); };
}

NodalVectors pushed(const Solid& solid, const std::vector<Face>& faces, double p, const NodalVectors& x) {
  NodalVectors f = NodalVectors::Zero(3, x.cols());
  for (const Face face : faces)
    structure::FollowingPressure(solid, structure::skin_surface(solid, {0, face}), pressure_of(p), {})
        .add(0.0, x, structure::Halo(), f);
  return f;
}

const std::vector<Face> kAllFaces = {Face::xi_minus, Face::xi_plus,    Face::eta_minus,
                                     Face::eta_plus, Face::zeta_minus, Face::zeta_plus};

// Of a closed skin, however it is deformed: no force, no moment.
TEST(FollowingPressure, OfAClosedSkinHasNoForceAndNoMoment) {
  for (int degree : {2, 3}) {
    const Solid solid(models::block({1, 2, 3}, {2, 1, 2}, degree), models::elastic());
    const NodalVectors x = solid.reference() + 0.2 * models::random_vectors(solid.node_count(), 4);
    const NodalVectors f = pushed(solid, kAllFaces, 2.0, x);
    Vector3 moment = Vector3::Zero();
    for (int A = 0; A < f.cols(); ++A) moment += Vector3(x.col(A)).cross(Vector3(f.col(A)));
    EXPECT_LT(f.rowwise().sum().norm(), 1e-13);
    EXPECT_LT(moment.norm(), 1e-13);
    EXPECT_GT(f.norm(), 0.1);
  }
}

/// K - dF/du of a thick plate that is held below, under a pressure above: its largest eigenvalue with lumped
/// masses, which sets the stable step.
double largest_eigenvalue(const Solid& solid, double p) {
  const Eigen::Index dofs = 3 * solid.node_count();
  Eigen::MatrixXd K = models::stiffness(solid);
  constexpr double kStep = 1e-6;
  for (Eigen::Index dof = 0; dof < dofs && p != 0.0; ++dof) {
    NodalVectors x = solid.reference();
    x.data()[dof] += kStep;
    const NodalVectors above = pushed(solid, {Face::zeta_plus}, p, x);
    x.data()[dof] -= 2 * kStep;
    K.col(dof) -= (above - pushed(solid, {Face::zeta_plus}, p, x)).reshaped() / (2 * kStep);
  }
  const Eigen::VectorXd m = Eigen::VectorXd(solid.row_sum_mass()).replicate(1, 3).transpose().reshaped();
  return (m.cwiseInverse().asDiagonal() * K).eigenvalues().cwiseAbs().maxCoeff();
}

// What a pressure p does to the stable step is less than the share p/E of it: its stiffness is one of p times
// an area, that of the solid one of E.
TEST(FollowingPressure, ChangesTheStableStepByLessThanItsShareOfTheModulus) {
  for (const int degree : {2, 3}) {
    for (const double height : {1.0, 0.1}) {
      const Solid solid(models::block({1, 1, height}, {2, 2, 1}, degree), models::elastic(1.0, 0.3));
      const double without = largest_eigenvalue(solid, 0.0);
      for (const double p : {0.05, -0.05}) {
        const double change = std::sqrt(without / largest_eigenvalue(solid, p)) - 1.0;
        EXPECT_LT(std::abs(change), 0.05) << degree << ' ' << height;
        EXPECT_GT(std::abs(change), 1e-6) << "it has one";
      }
    }
  }
}

// The power of the pressure is p times the rate of the volume that is left outside: f = -p dV/dx.
TEST(FollowingPressure, IsTheDerivativeOfTheVolume) {
  const Solid solid(models::block({1, 2, 1}, {2, 2, 1}, 2), models::elastic());
  const NodalVectors x = solid.reference() + 0.1 * models::random_vectors(solid.node_count(), 5),
                     v = models::random_vectors(solid.node_count(), 6);
  const auto volume = [&](const NodalVectors& places) {
    return Solid(nurbs::Volume{solid.space(), places}, models::elastic()).volume();
  };
  const double h = 1e-5, rate = (volume(x + h * v) - volume(x - h * v)) / (2 * h);
  EXPECT_NEAR(pushed(solid, kAllFaces, 3.0, x).cwiseProduct(v).sum(), -3.0 * rate, 1e-8);
}

// On the inside of a quarter ring that is turned: p times the projected area, whatever the turn.
TEST(FollowingPressure, TurnsWithTheBody) {
  const Solid ring(models::quarter_ring(2, 4), models::elastic());
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  const NodalVectors x = R * ring.reference();
  const Vector3 force = pushed(ring, {Face::xi_minus}, 2.0, x).rowwise().sum();  // radius 1, height 1
  EXPECT_LT((force - R * Vector3(2, 2, 0)).norm(), 1e-6);
}

// The same as the dead traction -p n as long as nothing moves.
TEST(FollowingPressure, OfAnUndeformedPlaneIsATraction) {
  const Solid solid(models::block({1, 2, 3}, {2, 2, 2}, 2), models::elastic());
  const NodalVectors f = pushed(solid, {Face::eta_minus}, 2.0, solid.reference());
  EXPECT_LT((f - structure::traction_load(solid, {0, Face::eta_minus}, {0, 2, 0})).norm(), 1e-14);
}

// A linear traction on a plane has force and moment of its distribution.
TEST(SkinQuadrature, IntegratesFields) {
  const Solid solid(models::block({2, 1, 3}, {2, 1, 2}, 2), models::elastic());
  NodalVectors f = NodalVectors::Zero(3, solid.node_count());
  structure::SkinQuadrature(structure::skin_surface(solid, {0, Face::xi_plus}), ids(solid))
      .integrate([](const Vector3& X) { return Vector3(X[2], 0, X[1] * X[2]); }, f);
  EXPECT_LT((f.rowwise().sum() - Vector3(4.5, 0, 2.25)).norm(), 1e-13);
  double moment = 0.0;
  for (int A = 0; A < f.cols(); ++A) moment += solid.reference()(2, A) * f(0, A);
  EXPECT_NEAR(moment, 9.0, 1e-12);  // integral of z^2
}

TEST(LineLoad, IsPerLengthOfAnArc) {
  const Solid ring(models::quarter_ring(2, 4), models::elastic());
  NodalVectors f = NodalVectors::Zero(3, ring.node_count());
  structure::add_line_load(
      whole_patch(ring), ids(ring), {Face::zeta_plus, Face::xi_plus},
      [](const Vector3& X, double) { return Vector3(1.0, X[0], 0.0); }, structure::Columns(ids(ring)), f);
  EXPECT_LT((f.rowwise().sum() - Vector3(nurbs::kPi, 4.0, 0.0)).norm(),
            1e-6);  // radius 2: integral of x is 4
  for (int A = 0; A < f.cols(); ++A)
    if (ring.reference()(2, A) < 1.0) {
      EXPECT_EQ(f.col(A).norm(), 0.0);
    }
}

TEST(PointLoad, ActsAtItsPoint) {
  const Solid solid(models::block({1, 2, 3}, {3, 2, 2}, 2), models::elastic());
  const structure::Probe point = structure::probe_at(
      "", solid.space(), structure::face_point(solid.space(), Face::zeta_plus, {0.3, 0.6}));
  const NodalVectors u = models::random_vectors(solid.node_count(), 7);
  NodalVectors f = NodalVectors::Zero(3, solid.node_count());
  structure::add_point_load(point, {1, -2, 3}, structure::Columns(ids(solid)), f);
  EXPECT_NEAR(f.cwiseProduct(u).sum(), Vector3(1, -2, 3).dot(point.value(u)), 1e-14);
}

TEST(BodyForce, OfTheDensityIsGravity) {
  const Solid ring(models::quarter_ring(3, 2), models::elastic(1.0, 0.3, 2.5));
  const Vector3 g(1, 2, -9.81);
  NodalVectors f = NodalVectors::Zero(3, ring.node_count());
  structure::add_body_force(
      whole_patch(ring), ids(ring), [&](const Vector3&, double) { return Vector3(2.5 * g); },
      structure::Columns(ids(ring)), f);
  EXPECT_LT((f - structure::gravity_load(ring, g)).norm(), 1e-5 * f.norm());
}

// A part gets what the whole body has at its nodes, to the last bit.
TEST(Loads, OfAPartAreThoseOfTheWhole) {
  const Solid solid(models::block({2, 1, 3}, {2, 2, 2}, 2), models::elastic());
  const std::vector<Id> part = {40, 41, -1, 7, 60, 61, 62, 63};
  const structure::Field field = [](const Vector3& X, double) { return Vector3(X[2], 1.0, X[0] * X[1]); };
  const auto loads = [&](const std::vector<Id>& nodes) {
    NodalVectors f = NodalVectors::Zero(3, nodes.size());
    const structure::Columns columns(nodes);
    structure::add_body_force(whole_patch(solid), ids(solid), field, columns, f);
    structure::add_line_load(whole_patch(solid), ids(solid), {Face::zeta_plus, Face::eta_plus}, field,
                             columns, f);
    structure::SkinQuadrature(structure::skin_surface(solid, {0, Face::zeta_plus}), nodes)
        .integrate([&](const Vector3& X) { return field(X, 0.0); }, f);
    return f;
  };
  const NodalVectors whole = loads(ids(solid)), here = loads(part);
  for (std::size_t column = 0; column < part.size(); ++column)
    EXPECT_EQ(here.col(column), part[column] < 0 ? Vector3(0, 0, 0) : Vector3(whole.col(part[column])));
}

}  // namespace
