// SPDX-License-Identifier: GPL-2.0-or-later
// Projection to Bezier points, and faces: against fields that are known in closed form or on the patch's own
// basis.
#include "vtk/bezier_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "nurbs/gauss_legendre.h"
#include "nurbs/primitives.h"
#include "vtk/bezier_cells.h"

namespace {

using nurbs::KnotVector;
using nurbs::Parameter;

/// Degrees 2, 3, 1; uneven knots, one repeated.
nurbs::Space<3> some_space(bool rational) {
  const std::array<KnotVector, 3> knots{KnotVector(2, {0, 0, 0, 0.3, 0.3, 1.1, 2, 2, 2}),
                                        KnotVector(3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1}),
                                        KnotVector::uniform(1, 2)};
  std::vector<double> weights(rational ? 6 * 5 * 3 : 0);
  std::mt19937 random(7);
  for (double& weight : weights) weight = 0.5 + 1e-9 * (random() % 1000000000);
  return nurbs::Space<3>(knots, weights);
}

Eigen::MatrixXd random_values(int rows, int columns) {
  std::srand(5);
  return Eigen::MatrixXd::Random(rows, columns);
}

using FieldAt = std::function<Eigen::VectorXd(const nurbs::RationalBasis<3>&, const Parameter<3>&)>;

Eigen::MatrixXd at_gauss_points(const nurbs::Space<3>& space, int element, int rows, const FieldAt& field) {
  const nurbs::Indices<3> span = space.element_indices(element);
  std::vector<double> points[3];
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& breaks = space.knots(d).breaks();
    points[d] = nurbs::gauss_legendre(space.degree(d) + 1, breaks[span[d]], breaks[span[d] + 1]).points;
  }
  Eigen::MatrixXd values(rows, space.functions_per_element());
  int column = 0;
  nurbs::RationalBasis<3> basis;
  for (double z : points[2])
    for (double y : points[1])
      for (double x : points[0]) {
        nurbs::evaluate_on_element(space, element, {x, y, z}, 0, basis);
        values.col(column++) = field(basis, {x, y, z});
      }
  return values;
}

Eigen::MatrixXd projected(const nurbs::Space<3>& space, int rows, const FieldAt& field) {
  vtk::BezierProjection projection(space, rows);
  for (int e = 0; e < space.element_count(); ++e) projection.add(e, at_gauss_points(space, e, rows, field));
  return projection.coefficients();
}

template <int Dim>
Eigen::VectorXd value(const nurbs::Space<Dim>& space, const Eigen::MatrixXd& q, const Parameter<Dim>& xi) {
  nurbs::RationalBasis<Dim> basis;
  nurbs::evaluate(space, xi, 0, basis);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(q.rows());
  for (int a = 0; a < basis.count; ++a) sum += basis.R[a] * q.col(basis.control_point[a]);
  return sum;
}

TEST(BezierProjection, ReproducesEveryFieldOfThePatch) {
  for (const bool rational : {false, true}) {
    const nurbs::Space<3> space = some_space(rational), bezier = vtk::bezier_space(space);
    const Eigen::MatrixXd q = random_values(7, space.control_point_count());
    const Eigen::MatrixXd b = projected(space, 7, [&](const nurbs::RationalBasis<3>& basis, const auto&) {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(7);
      for (int a = 0; a < basis.count; ++a) sum += basis.R[a] * q.col(basis.control_point[a]);
      return sum;
    });
    ASSERT_EQ(b.cols(), bezier.control_point_count());
    for (const Parameter<3> xi : {Parameter<3>{0.1, 0.2, 0.3}, {0.3, 0.4, 0.5}, {1.9, 0.7, 1.0}})
      EXPECT_LT((value(bezier, b, xi) - value(space, q, xi)).lpNorm<Eigen::Infinity>(), 1e-12)
          << "rational " << rational;
  }
}

TEST(BezierProjection, ErrorOfASmoothFieldFallsWithDegreePlusOne) {
  const auto field = [](const Parameter<3>& xi) {
    return std::sin(3.0 * xi[0]) * std::cos(2.0 * xi[1] + xi[2]);
  };
  const auto error = [&](int elements) {
    const nurbs::Space<3> space({KnotVector::uniform(2, elements), KnotVector::uniform(2, elements),
                                 KnotVector::uniform(2, elements)});
    const Eigen::MatrixXd b = projected(space, 1, [&](const auto&, const Parameter<3>& xi) {
      return Eigen::VectorXd::Constant(1, field(xi));
    });
    const nurbs::Space<3> bezier = vtk::bezier_space(space);
    double largest = 0.0;
    for (double t = 0.011; t < 1.0; t += 0.017) {
      const Parameter<3> xi{t, std::fmod(3.1 * t, 1.0), std::fmod(7.3 * t, 1.0)};
      largest = std::max(largest, std::abs(value(bezier, b, xi)[0] - field(xi)));
    }
    return largest;
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 3.0, 0.4);
}

TEST(BezierProjection, IsZeroWhereNoElementWasAdded) {
  const nurbs::Space<3> space = some_space(false);
  vtk::BezierProjection projection(space, 1);
  projection.add(0, Eigen::MatrixXd::Ones(1, space.functions_per_element()));
  const Eigen::MatrixXd b = projection.coefficients();
  EXPECT_NEAR(b.sum(), space.functions_per_element(), 1e-12);
}

TEST(OnFace, HasTheFieldsOfTheVolumeThere) {
  for (const bool rational : {false, true})
    for (const nurbs::Face face : {nurbs::Face::xi_minus, nurbs::Face::eta_plus, nurbs::Face::zeta_plus}) {
      const nurbs::Space<3> space = some_space(rational), bezier = vtk::bezier_space(space);
      const Eigen::MatrixXd X = random_values(3, space.control_point_count()),
                            b = random_values(2, bezier.control_point_count());
      const vtk::PatchFields<2> skin = vtk::on_face({{space, X}, {{"X", X}}, {}, {{"b", b, "Pa"}}}, face);
      const int d = static_cast<int>(face) / 2;
      const nurbs::KnotVector& across = space.knots(d);
      Parameter<3> xi{0.7, 0.3, 0.6};
      Parameter<2> on{d == 0 ? xi[1] : xi[0], d == 2 ? xi[1] : xi[2]};
      xi[d] = static_cast<int>(face) % 2 ? across.back() : across.front();
      EXPECT_LT((value(skin.patch.space, skin.control_points[0].values, on) - value(space, X, xi)).norm(),
                1e-13);
      EXPECT_LT((value(vtk::bezier_space(skin.patch.space), skin.bezier_points[0].values, on) -
                 value(bezier, b, xi))
                    .norm(),
                1e-13);
      EXPECT_EQ(skin.bezier_points[0].unit, "Pa");
    }
}

}  // namespace
