// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/element_tables.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace structure {

namespace {

/// dX/dxi from reference control points: J(i, d) = sum_A X_A,i dR_A/dxi_d.
Matrix3 jacobian(const nurbs::RationalBasis<3>& basis, const ElementNet& net) {
  Matrix3 J = Matrix3::Zero();
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 3; ++d) J.col(d) += basis.dR[d][a] * net.X.col(net.columns[a]);
  return J;
}

[[noreturn]] void throw_not_positive(double det_J, int element, const std::array<int, 3>& span) {
  throw std::invalid_argument(fmt::format(
      "Solid: Jacobian determinant {} in element {} (spans {}, {}, {} of xi, eta, zeta), expected > 0: "
      "the patch is left-handed or folded there",
      det_J, element, span[0], span[1], span[2]));
}

}  // namespace

ElementTabulator::ElementTabulator(const nurbs::Space<3>& space, Quadrature quadrature) : space_(space) {
  for (int d = 0; d < 3; ++d) {
    rules_[d] = rules_of(space.knots(d), quadrature);
    for (const nurbs::QuadratureRule& rule : rules_[d])
      most_[d] = std::max(most_[d], static_cast<int>(rule.points.size()));
  }
}

/// at_point(basis, J, w|J|, slot)
template <class AtPoint>
void ElementTabulator::for_each_point(int element, const ElementNet& net, AtPoint at_point) const {
  const std::array<int, 3> span = space_.element_indices(element);
  const nurbs::QuadratureRule &x = rules_[0][span[0]], &y = rules_[1][span[1]], &z = rules_[2][span[2]];
  nurbs::RationalBasis<3> basis;
  for (std::size_t k = 0; k < z.points.size(); ++k)
    for (std::size_t j = 0; j < y.points.size(); ++j)
      for (std::size_t i = 0; i < x.points.size(); ++i) {
        nurbs::evaluate_on_element(space_, element, {x.points[i], y.points[j], z.points[k]}, 1, basis);
        const Matrix3 J = jacobian(basis, net);
        const double det_J = J.determinant();
        if (!(det_J > 0.0)) throw_not_positive(det_J, element, span);
        at_point(basis, J, x.weights[i] * y.weights[j] * z.weights[k] * det_J,
                 static_cast<int>(i) + most_[0] * (static_cast<int>(j) + most_[1] * static_cast<int>(k)));
      }
}

void ElementTabulator::operator()(int element, const ElementNet& net, ElementTables& tables) const {
  const int functions = space_.functions_per_element();
  tables.points = 0;
  tables.padded = padded(functions);
  tables.wJ.clear();
  tables.slot.clear();
  tables.dR_dX.assign(std::size_t(slots()) * 3 * tables.padded, 0.0);
  for_each_point(
      element, net, [&](const nurbs::RationalBasis<3>& basis, const Matrix3& J, double wJ, int slot) {
        double* dR_dX = &tables.dR_dX[std::size_t(tables.points++) * 3 * tables.padded];
        tables.wJ.push_back(wJ);
        tables.slot.push_back(slot);
        const Matrix3 J_inverse_transposed = J.inverse().transpose();
        for (int a = 0; a < functions; ++a) {
          const nurbs::Vector3 gradient =
              J_inverse_transposed * nurbs::Vector3(basis.dR[0][a], basis.dR[1][a], basis.dR[2][a]);
          for (int d = 0; d < 3; ++d) dR_dX[d * tables.padded + a] = gradient[d];
        }
      });
}

void ElementTabulator::add_row_sums(int element, const ElementNet& net, double* sums) const {
  for_each_point(element, net, [&](const nurbs::RationalBasis<3>& basis, const Matrix3&, double wJ, int) {
    for (int a = 0; a < basis.count; ++a) sums[a] += basis.R[a] * wJ;
  });
}

Eigen::MatrixXd ElementTabulator::products(int element, const ElementNet& net) const {
  const int functions = space_.functions_per_element();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(functions, functions);
  for_each_point(element, net, [&](const nurbs::RationalBasis<3>& basis, const Matrix3&, double wJ, int) {
    const auto R = Eigen::VectorXd::Map(basis.R, functions);
    products.noalias() += wJ * R * R.transpose();
  });
  return products;
}

int ElementTabulator::nearest_slot(const std::array<int, 3>& span, const nurbs::Parameter<3>& xi) const {
  int slot = 0;
  for (int d = 2; d >= 0; --d) {
    const std::vector<double>& points = rules_[d][span[d]].points;
    const auto nearest = std::min_element(points.begin(), points.end(), [&](double a, double b) {
      return std::abs(a - xi[d]) < std::abs(b - xi[d]);
    });
    slot = slot * most_[d] + static_cast<int>(nearest - points.begin());
  }
  return slot;
}

}  // namespace structure
