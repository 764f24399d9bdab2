// SPDX-License-Identifier: GPL-2.0-or-later
// Stresses at Gauss points: against those of a solid at a point, its energy, and closed forms.
#include "structure/solid/gauss_stresses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models.h"
#include "nurbs/gauss_legendre.h"
#include "standard_linear_solid.h"

namespace {

using models::NodalVectors;
using structure::GaussStresses;
using structure::Matrix3;
using structure::Quadrature;
using structure::Solid;

/// visit(point, weight, xi) for the Gauss points of an element, in the order of GaussStresses.
template <class Visit>
void for_each_gauss_point(const nurbs::Space<3>& space, int element, Visit visit) {
  nurbs::QuadratureRule rule[3];
  for (int d = 0; d < 3; ++d) {
    const int span = space.element_indices(element)[d];
    const std::vector<double>& breaks = space.knots(d).breaks();
    rule[d] = nurbs::gauss_legendre(space.degree(d) + 1, breaks[span], breaks[span + 1]);
  }
  int q = 0;
  for (std::size_t k = 0; k < rule[2].points.size(); ++k)
    for (std::size_t j = 0; j < rule[1].points.size(); ++j)
      for (std::size_t i = 0; i < rule[0].points.size(); ++i)
        visit(q++, rule[0].weights[i] * rule[1].weights[j] * rule[2].weights[k],
              nurbs::Parameter<3>{rule[0].points[i], rule[1].points[j], rule[2].points[k]});
}

TEST(GaussStresses, AreThoseOfTheSolidThere) {
  for (const nurbs::Volume& patch :
       {models::distorted(models::block({3, 2, 2}, {3, 2, 2}, {2, 3, 2}), 0.1), models::quarter_ring(2, 2)}) {
    const auto material = std::make_shared<structure::SaintVenantKirchhoff>(2.0, 0.3, 1.0);
    const Solid solid(patch, material);
    const NodalVectors u = 0.05 * models::random_vectors(solid.node_count(), 3);
    GaussStresses stresses(patch, *material, Quadrature::full);
    double energy = 0.0;
    for (int e = 0; e < patch.space.element_count(); ++e) {
      const std::vector<structure::PointStress>& points = stresses.at(e, u, {});
      for_each_gauss_point(patch.space, e, [&](int q, double weight, const nurbs::Parameter<3>& xi) {
        const Matrix3 F = Matrix3::Identity() + solid.displacement_gradient(u, xi);
        const Matrix3 expected = solid.stress(u, xi) * F.transpose() / F.determinant();
        EXPECT_LT((points[q].cauchy - expected).norm(), 1e-12 * expected.norm());
        EXPECT_LT((points[q].cauchy - points[q].cauchy.transpose()).norm(), 1e-12 * expected.norm());
        const Matrix3 J = [&] {  // dX/dxi
          nurbs::RationalBasis<3> basis;
          nurbs::evaluate(patch.space, xi, 1, basis);
          Matrix3 sum = Matrix3::Zero();
          for (int a = 0; a < basis.count; ++a)
            for (int d = 0; d < 3; ++d)
              sum.col(d) += basis.dR[d][a] * patch.control_points.col(basis.control_point[a]);
          return sum;
        }();
        energy += weight * J.determinant() * points[q].energy_density;
      });
    }
    EXPECT_NEAR(energy, solid.strain_energy(u), 1e-12 * energy);
  }
}

// A bar pulled to twice its length without getting thinner: P11 = (2 mu + lambda) F E, and the cross section
// stays, so sigma = P11.
TEST(GaussStresses, CauchyStressOfAStretchedBlock) {
  const nurbs::Volume patch = models::block({1, 1, 1}, {1, 1, 1}, 2);
  const Matrix3 stretch = Eigen::Vector3d(1.0, 0.0, 0.0).asDiagonal();
  const NodalVectors u = models::linear_field(stretch, patch.control_points);
  const structure::SaintVenantKirchhoff large(2.5, 0.25, 1.0);  // lambda = mu = 1
  EXPECT_NEAR(GaussStresses(patch, large, Quadrature::full).at(0, u, {})[13].cauchy(0, 0), 3.0 * 2.0 * 1.5,
              1e-12);
  // Across: P22 = lambda E on an area that is twice as large.
  EXPECT_NEAR(GaussStresses(patch, large, Quadrature::full).at(0, u, {})[13].cauchy(1, 1), 1.5 / 2.0, 1e-12);
  // The law for small strain knows one area only.
  const structure::LinearElastic small(2.5, 0.25, 1.0);
  EXPECT_NEAR(GaussStresses(patch, small, Quadrature::full).at(0, u, {})[13].cauchy(0, 0), 3.0, 1e-12);
  EXPECT_NEAR(GaussStresses(patch, small, Quadrature::full).at(0, u, {})[13].cauchy(1, 1), 1.0, 1e-12);
}

TEST(GaussStresses, RememberTheNearestPointOfTheQuadrature) {
  const nurbs::Volume patch = models::block({35, 2, 2}, {35, 2, 2}, 2);  // two boxes
  const auto material = std::make_shared<test::StandardLinearSolid>(1.0, 0.3, 1.0, 0.3, 2.0);
  for (const Quadrature quadrature : {Quadrature::full, Quadrature::reduced}) {
    Solid solid(patch, material, {quadrature, structure::IntegrationMethod::automatic});
    const NodalVectors u = 0.01 * models::random_vectors(solid.node_count(), 4);
    NodalVectors f(u);
    solid.evolve(u, 1.0, f);
    solid.commit();
    GaussStresses stresses(patch, *material, quadrature);
    for (const int e : {0, 1, 33, 34, 70, 139}) {
      const std::vector<structure::PointStress>& points = stresses.at(e, u, solid.memory());
      for_each_gauss_point(patch.space, e, [&](int q, double, const nurbs::Parameter<3>& xi) {
        const Matrix3 F = Matrix3::Identity() + solid.displacement_gradient(u, xi);
        const Matrix3 expected = solid.stress(u, xi) * F.transpose() / F.determinant();
        EXPECT_LT((points[q].cauchy - expected).norm(), 1e-12 * expected.norm()) << "element " << e;
      });
    }
  }
}

}  // namespace
