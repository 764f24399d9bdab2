// SPDX-License-Identifier: GPL-2.0-or-later
#include "gauss_loop.h"

#include <Eigen/LU>

#include <cmath>

#include "nurbs/gauss_legendre.h"

namespace benchmarks {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using nurbs::NodalVectors;

namespace {

/// Gradients of one point, in column `q`.
void evaluate_point(const nurbs::Volume& volume, int element, const nurbs::Parameter<3>& xi, double weight,
                    int q, Gradients& out) {
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate_on_element(volume.space, element, xi, 1, basis);
  const auto dR = [&](int d) { return Eigen::Map<const Eigen::VectorXd>(basis.dR[d], basis.count); };
  Matrix3d J = Matrix3d::Zero();
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 3; ++d)
      J.col(d) += volume.control_points.col(basis.control_point[a]) * basis.dR[d][a];
  const Matrix3d inverse = J.inverse();
  for (int i = 0; i < 3; ++i)
    out.along[i].col(q) = inverse(0, i) * dR(0) + inverse(1, i) * dR(1) + inverse(2, i) * dR(2);
  out.wJ[q] = weight * J.determinant();
  out.nodes.assign(basis.control_point, basis.control_point + basis.count);
}

/// In long double: F - F^-T has lost digits where H is small.
Matrix3d neo_hooke(double lambda, double mu, const Matrix3d& H) {
  using Long = Eigen::Matrix<long double, 3, 3>;
  const Long F = Long::Identity() + H.cast<long double>(), inverse = F.inverse().transpose();
  return (mu * (F - inverse) + lambda * std::log(F.determinant()) * inverse).cast<double>();
}

/// P of H.
Matrix3d stress(const std::string& law, double lambda, double mu, const Matrix3d& H) {
  if (law == "neo_hooke") return neo_hooke(lambda, mu, H);
  const Matrix3d I = Matrix3d::Identity(), F = I + H;
  const bool linear = law == "linear_elastic";
  const Matrix3d E =
      linear ? Matrix3d(0.5 * (H + H.transpose())) : Matrix3d(0.5 * (H + H.transpose() + H.transpose() * H));
  const Matrix3d S = lambda * E.trace() * I + 2.0 * mu * E;
  return linear ? S : Matrix3d(F * S);
}

}  // namespace

int gauss_points(Rule rule, const nurbs::KnotVector& knots, int span) {
  const int p = knots.degree();
  if (rule == Rule::full) return p + 1;
  const bool inner = 0 < span && span + 1 < knots.element_count();
  return rule == Rule::zou && inner ? p - 1 : p;
}

Gradients gradients(const nurbs::Volume& volume, int element, Rule rule) {
  const nurbs::Indices<3> span = volume.space.element_indices(element);
  nurbs::QuadratureRule rules[3];
  int points[3];
  for (int d = 0; d < 3; ++d) {
    const nurbs::KnotVector& knots = volume.space.knots(d);
    points[d] = gauss_points(rule, knots, span[d]);
    rules[d] = nurbs::gauss_legendre(points[d], knots.breaks()[span[d]], knots.breaks()[span[d] + 1]);
  }
  const int all = points[0] * points[1] * points[2];
  Gradients result;
  for (MatrixXd& G : result.along) G.resize(volume.space.functions_per_element(), all);
  result.wJ.resize(all);
  for (int q = 0; q < all; ++q) {
    const int at[3] = {q % points[0], q / points[0] % points[1], q / points[0] / points[1]};
    nurbs::Parameter<3> xi;
    double weight = 1.0;
    for (int d = 0; d < 3; ++d) xi[d] = rules[d].points[at[d]], weight *= rules[d].weights[at[d]];
    evaluate_point(volume, element, xi, weight, q, result);
  }
  return result;
}

NodalVectors integrated_force(const nurbs::Volume& volume, Rule rule, const std::string& law, double lambda,
                              double mu, const NodalVectors& u) {
  NodalVectors f = NodalVectors::Zero(3, u.cols());
  for (int e = 0; e < volume.space.element_count(); ++e) {
    const Gradients G = gradients(volume, e, rule);
    const NodalVectors u_e = u(Eigen::all, G.nodes);
    NodalVectors f_e = NodalVectors::Zero(3, u_e.cols());
    for (int q = 0; q < G.wJ.size(); ++q) {
      NodalVectors dR(3, u_e.cols());  // column A: dR_A/dX
      for (int j = 0; j < 3; ++j) dR.row(j) = G.along[j].col(q).transpose();
      f_e += G.wJ[q] * stress(law, lambda, mu, u_e * dR.transpose()) * dR;
    }
    f(Eigen::all, G.nodes) += f_e;
  }
  return f;
}

}  // namespace benchmarks
