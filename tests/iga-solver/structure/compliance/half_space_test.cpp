// SPDX-License-Identifier: GPL-2.0-or-later
// The half-space under a point force, and the factor of a matrix with a band.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "models.h"
#include "nurbs/gauss_legendre.h"
#include "nurbs/primitives.h"
#include "structure/compliance/band_matrix.h"
#include "structure/compliance/half_space.h"

namespace {

using models::Matrix3;
using models::Vector3;
using structure::HalfSpace;

constexpr double kPoisson = 0.286;

TEST(HalfSpace, IsInEquilibriumUnderTheForce) {
  const Vector3 n = Vector3(1, -2, 3).normalized();
  const HalfSpace half_space(2.0, kPoisson, n);
  // deep enough that the plane through it has no force of its own: tractions on a sphere around the point of
  // the force, as far as it is in the body, bear the force
  Matrix3 sum = Matrix3::Zero();
  const Matrix3 axes = nurbs::frame(Vector3::Zero(), -n).axes;
  const nurbs::QuadratureRule polar = nurbs::gauss_legendre(8, 0.0, 1.0);
  constexpr int kAround = 24;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < kAround; ++k) {
      const double z = polar.points[i], r = std::sqrt(1.0 - z * z), angle = nurbs::kTwoPi * k / kAround;
      const Vector3 m = axes * Vector3(r * std::cos(angle), r * std::sin(angle), z);
      sum += polar.weights[i] * nurbs::kTwoPi / kAround * half_space.traction(m, m);
    }
  EXPECT_LT((sum + Matrix3::Identity()).norm(), 1e-4);
  // the surface is free
  const Vector3 along = n.cross(Vector3(0, 1, 0));
  EXPECT_LT(half_space.traction(along, n).norm(), 1e-14);
  // and sinks by (1 - nu^2) / (pi E r) (Johnson 1985, eq. 3.22b)
  EXPECT_NEAR(n.dot(half_space.displacement(2.0 * along) * n),
              (1 - kPoisson * kPoisson) / (nurbs::kPi * 2.0 * 2.0 * along.norm()), 1e-15);
}

TEST(HalfSpace, TractionIsThatOfTheDisplacement) {
  const HalfSpace half_space(2.0, kPoisson, Vector3::UnitZ());
  const double mu = 1.0 / (1.0 + kPoisson), lambda = 2.0 * mu * kPoisson / (1.0 - 2.0 * kPoisson),
               step = 1e-4;
  const auto stress = [&](const Vector3& x, int force) -> Matrix3 {
    Matrix3 H;
    for (int k = 0; k < 3; ++k)
      H.col(k) = (half_space.displacement(x + step * Vector3::Unit(k)).col(force) -
                  half_space.displacement(x - step * Vector3::Unit(k)).col(force)) /
                 (2.0 * step);
    return lambda * H.trace() * Matrix3::Identity() + mu * (H + H.transpose());
  };
  const Vector3 x(0.3, -0.5, -0.4), m = Vector3(1, 2, -2) / 3.0;
  for (int force = 0; force < 3; ++force) {
    EXPECT_LT((half_space.traction(x, m).col(force) - stress(x, force) * m).norm(), 1e-7);
    Vector3 divergence = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      divergence += (half_space.traction(x + step * Vector3::Unit(k), Vector3::Unit(k)) -
                     half_space.traction(x - step * Vector3::Unit(k), Vector3::Unit(k)))
                        .col(force) /
                    (2.0 * step);
    EXPECT_LT(divergence.norm(), 1e-6);
  }
}

// Blocks of a factor are 48 rows: one block, whole ones, a last one of one row; bands narrower and wider than
// a block.
TEST(BandMatrix, SolvesAsADenseFactorDoes) {
  for (const auto& [rows, half_width] :
       {std::pair{5, 2}, {48, 7}, {97, 1}, {97, 60}, {150, 149}, {200, 20}}) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, rows);
    structure::BandMatrix band;
    band.reset(rows, half_width);
    for (int j = 0; j < rows; ++j)
      for (int i = j; i <= std::min(j + half_width, rows - 1); ++i)
        band.at(i, j) = A(i, j) = A(j, i) = i == j ? 2.0 * half_width + 3.0 : std::sin(3.0 * i + 7.0 * j);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(rows, 4);
    Eigen::MatrixXd x = b;
    ASSERT_TRUE(band.factorise());
    band.solve(x);
    EXPECT_LT((x - A.llt().solve(b)).norm(), 1e-13 * b.norm()) << rows << " rows, " << half_width;
  }
}

TEST(BandMatrix, SaysWhatIsNotPositiveDefinite) {
  structure::BandMatrix band;
  band.reset(60, 3);
  for (int i = 0; i < 60; ++i) band.at(i, i) = i == 55 ? -1.0 : 1.0;
  EXPECT_FALSE(band.factorise());
}

}  // namespace
