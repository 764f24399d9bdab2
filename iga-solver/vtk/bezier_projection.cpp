// SPDX-License-Identifier: GPL-2.0-or-later
#include "vtk/bezier_projection.h"

#include <Eigen/LU>

#include <cmath>

#include "nurbs/assert.h"
#include "nurbs/gauss_legendre.h"
#include "vtk/bezier_cells.h"

namespace vtk {

namespace {

/// Bernstein polynomials of degree p at the p + 1 Gauss points: [point, function].
Eigen::MatrixXd bernstein_at_gauss_points(int p) {
  const std::vector<double> points = nurbs::gauss_legendre(p + 1, 0.0, 1.0).points;
  Eigen::MatrixXd values(p + 1, p + 1);
  for (int i = 0; i <= p; ++i)
    for (int k = 0; k <= p; ++k)
      values(i, k) = nurbs::binomial(p, k) * std::pow(points[i], k) * std::pow(1.0 - points[i], p - k);
  return values;
}

}  // namespace

BezierProjection::BezierProjection(const nurbs::Space<3>& space, int components)
    : space_(space),
      bezier_(bezier_space(space)),
      sums_(Eigen::MatrixXd::Zero(components, bezier_.control_point_count())),
      elements_(Eigen::VectorXd::Zero(bezier_.control_point_count())) {
  for (int d = 0; d < 3; ++d) {
    at_gauss_points_[d] = bernstein_at_gauss_points(space.degree(d));
    to_coefficients_[d] = at_gauss_points_[d].inverse();
  }
}

void BezierProjection::add(int element, const Eigen::MatrixXd& values) {
  std::vector<int> points(space_.functions_per_element());
  bezier_.element_control_points(element, points.data());
  NURBS_ASSERT(values.cols() == static_cast<int>(points.size()), values.cols(), points.size());
  Eigen::MatrixXd coefficients = values;
  Eigen::RowVectorXd weights(values.cols());
  for (Eigen::Index a = 0; a < values.cols(); ++a) weights[a] = bezier_.weight(points[a]);
  if (space_.rational()) {  // sum B w q = (sum B w) field
    const Eigen::RowVectorXd denominators = along_each_direction(at_gauss_points_, weights);
    coefficients = values * denominators.asDiagonal();
  }
  coefficients = along_each_direction(to_coefficients_, std::move(coefficients));
  for (Eigen::Index a = 0; a < values.cols(); ++a) {
    sums_.col(points[a]) += coefficients.col(a) / weights[a];
    elements_[points[a]] += 1.0;
  }
}

Eigen::MatrixXd BezierProjection::along_each_direction(const Eigen::MatrixXd (&matrices)[3],
                                                       Eigen::MatrixXd values) const {
  Eigen::MatrixXd result(values.rows(), values.cols());
  for (int d = 0, stride = 1; d < 3; stride *= space_.degree(d) + 1, ++d) {
    const int n = space_.degree(d) + 1;
    for (int a = 0; a < values.cols(); ++a) {
      const int i = a / stride % n, first = a - i * stride;
      result.col(a).setZero();
      for (int k = 0; k < n; ++k) result.col(a) += matrices[d](i, k) * values.col(first + k * stride);
    }
    values.swap(result);
  }
  return values;
}

Eigen::MatrixXd BezierProjection::coefficients() const {
  return sums_ * elements_.cwiseMax(1.0).cwiseInverse().asDiagonal();
}

}  // namespace vtk
