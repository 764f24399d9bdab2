// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/analysis/fast_diagonal.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "structure/analysis/coloured_products.h"
#include "structure/solid/quadrature.h"

namespace structure {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

const nurbs::Space<3>& space_of(const std::vector<nurbs::Space<3>>& patches) { return patches.front(); }

FastDiagonal::LineMatrices line_matrices(const nurbs::KnotVector& knots) {
  const int n = knots.control_point_count(), p = knots.degree();
  FastDiagonal::LineMatrices line{Matrix::Zero(n, n), Matrix::Zero(n, n)};
  const std::vector<nurbs::QuadratureRule> rules = rules_of(knots, Quadrature::full);
  nurbs::BasisFunctions basis;
  for (int e = 0; e < knots.element_count(); ++e)
    for (std::size_t q = 0; q < rules[e].points.size(); ++q) {
      nurbs::evaluate_basis(knots, knots.span_of_element(e), rules[e].points[q], 1, basis);
      const Eigen::Map<const Vector> B(basis.values[0], p + 1), dB(basis.values[1], p + 1);
      line.stiffness.block(basis.first, basis.first, p + 1, p + 1) +=
          rules[e].weights[q] * dB * dB.transpose();
      line.mass.block(basis.first, basis.first, p + 1, p + 1) += rules[e].weights[q] * B * B.transpose();
    }
  return line;
}

/// Means over the patch, in parameters: of w|J| dP_i/dH_i along dxi_d/dX on both sides, and of w|J|.
struct Coefficients {
  double stiffness[3][3] = {};  // [component][direction]
  double volume = 0.0;
};
Coefficients mean_coefficients(const Body& body, const nurbs::Space<3>& space) {
  Coefficients mean;
  const Material& material = *body.materials().front();
  const std::vector<double> no_memory(material.state_size(), 0.0);
  double parameters = 0.0;
  nurbs::RationalBasis<3> basis;
  for (int e = 0; e < space.element_count(); ++e) {
    nurbs::evaluate_on_element(space, e, space.element_centre(e), 1, basis);
    Matrix3 J = Matrix3::Zero();
    for (int a = 0; a < basis.count; ++a)
      for (int d = 0; d < 3; ++d) J.col(d) += basis.dR[d][a] * body.reference().col(basis.control_point[a]);
    const std::array<int, 3> span = space.element_indices(e);
    double size = 1.0;
    for (int d = 0; d < 3; ++d)
      size *= space.knots(d).breaks()[span[d] + 1] - space.knots(d).breaks()[span[d]];
    parameters += size;
    const double volume = size * J.determinant();
    mean.volume += volume;
    const Matrix3 K = J.inverse();
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) {
        Matrix3 G = Matrix3::Zero();
        G.row(i) = K.row(d);
        mean.stiffness[i][d] +=
            volume * material.stress_change(Matrix3::Zero(), G, no_memory.data()).row(i).dot(K.row(d));
      }
  }
  mean.volume /= parameters;
  for (auto& row : mean.stiffness)
    for (double& c : row) c /= parameters;
  return mean;
}

/// Sum of what c_d eigenvalue_d is in each mode, plus a mass.  Where a component is held by no whole face its
/// translation has none: then as much more for all modes as the softest of the others has.
Vector diagonal(const std::array<const Vector*, 3>& eigenvalues, const std::array<double, 3>& c,
                double mass) {
  const Vector &x = *eigenvalues[0], &y = *eigenvalues[1], &z = *eigenvalues[2];
  Vector sums(x.size() * y.size() * z.size());
  Eigen::Index next = 0;
  for (const double along_z : z)
    for (const double along_y : y)
      for (const double along_x : x) sums[next++] = c[0] * along_x + c[1] * along_y + c[2] * along_z + mass;
  constexpr double kRoundOff = 1e-10;
  if (sums.minCoeff() > kRoundOff * sums.maxCoeff()) return sums;
  double softest = sums.maxCoeff();
  for (int d = 0; d < 3; ++d)
    if (eigenvalues[d]->size() > 1) softest = std::min(softest, c[d] * (*eigenvalues[d])[1]);
  return sums.cwiseMax(0.0).array() + softest;
}

/// `values`, [..][n][inner], times a matrix along its middle index.
void multiply_along(const Matrix& factor, Eigen::Index inner, const Vector& values, Vector& out) {
  const Eigen::Index n = factor.rows(), block = inner * n;
  out.resize(values.size());
  if (inner == 1) {
    Eigen::Map<Matrix>(out.data(), n, values.size() / n).noalias() =
        factor.transpose() * Eigen::Map<const Matrix>(values.data(), n, values.size() / n);
    return;
  }
  for (Eigen::Index first = 0; first < values.size(); first += block)
    Eigen::Map<Matrix>(out.data() + first, inner, n).noalias() =
        Eigen::Map<const Matrix>(values.data() + first, inner, n) * factor;
}

}  // namespace

bool FastDiagonal::is_for(const Body& body) {
  const PatchSpaces patches = body.patches();
  const auto* const volumes = std::get_if<std::vector<nurbs::Space<3>>>(&patches);
  return volumes && volumes->size() == 1 && space_of(*volumes).control_point_count() == body.node_count();
}

template <class Visit>
void FastDiagonal::for_each_node(const Component& component, Visit visit) const {
  const auto& [x, y, z] = component.directions;
  Eigen::Index place = 0;
  for (int k = z.begin; k < z.end; ++k)
    for (int j = y.begin; j < y.end; ++j)
      for (int i = x.begin; i < x.end; ++i, ++place)
        visit(i + Eigen::Index(counts_[0]) * (j + Eigen::Index(counts_[1]) * k), place);
}

/// Whole faces that are fixed have no place in a component's values.
std::array<FastDiagonal::Direction, 3> FastDiagonal::free_directions(const Supports& supports,
                                                                     int component) const {
  std::vector<bool> fixed(std::size_t(counts_[0]) * counts_[1] * counts_[2], false);
  for (const Eigen::Index dof : supports.fixed_dofs())
    if (dof % 3 == component) fixed[dof / 3] = true;
  std::array<Direction, 3> directions;
  for (int d = 0; d < 3; ++d) {
    std::array<bool, 2> whole = {true, true};  // the first and the last face
    const std::size_t stride = d == 0 ? 1 : d == 1 ? counts_[0] : std::size_t(counts_[0]) * counts_[1];
    for (std::size_t node = 0; node < fixed.size(); ++node) {
      const int place = static_cast<int>(node / stride % counts_[d]);
      if (place == 0 && !fixed[node]) whole[0] = false;
      if (place == counts_[d] - 1 && !fixed[node]) whole[1] = false;
    }
    Direction& direction = directions[d];
    direction.begin = whole[0] ? 1 : 0;
    direction.end = counts_[d] - (whole[1] ? 1 : 0);
    const int first = direction.begin, n = std::max(0, direction.count());
    direction.end = first + n;
    if (n == 0) continue;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(
        lines_[d].stiffness.block(first, first, n, n), lines_[d].mass.block(first, first, n, n));
    direction.modes = solver.eigenvectors();
    direction.eigenvalues = solver.eigenvalues();
  }
  return directions;
}

FastDiagonal::FastDiagonal(const Tangent& tangent) : supports_(tangent.supports()) {
  const Body& body = tangent.body();
  const PatchSpaces patches = body.patches();
  const nurbs::Space<3>& space = space_of(std::get<std::vector<nurbs::Space<3>>>(patches));
  const Coefficients mean = mean_coefficients(body, space);
  for (int d = 0; d < 3; ++d) {
    counts_[d] = space.control_point_count(d);
    lines_[d] = line_matrices(space.knots(d));
  }
  mass_ = tangent.shift() * body.materials().front()->density() * mean.volume;
  for (int i = 0; i < 3; ++i) {
    Component& component = components_[i];
    component.directions = free_directions(supports_, i);
    std::copy_n(mean.stiffness[i], 3, component.coefficients.begin());
    const auto& [x, y, z] = component.directions;
    if (x.count() * y.count() * z.count() > 0)
      component.inverse =
          diagonal({&x.eigenvalues, &y.eigenvalues, &z.eigenvalues}, component.coefficients, mass_)
              .cwiseInverse();
  }
  set_scale(tangent);
}

/// Roots of the diagonal of P over that of the tangent.
void FastDiagonal::set_scale(const Tangent& tangent) {
  const std::vector<Matrix3> blocks = nodal_blocks(NodeGraph(tangent.body()), tangent.product());
  scale_ = NodalVectors::Ones(3, static_cast<Eigen::Index>(blocks.size()));
  for (int i = 0; i < 3; ++i)
    for_each_node(components_[i], [&](Eigen::Index node, Eigen::Index) {
      const Eigen::Index place[3] = {node % counts_[0], node / counts_[0] % counts_[1],
                                     node / (Eigen::Index(counts_[0]) * counts_[1])};
      double own = mass_, mass = 1.0;
      for (int d = 0; d < 3; ++d) {
        const double m = lines_[d].mass(place[d], place[d]);
        own += components_[i].coefficients[d] * lines_[d].stiffness(place[d], place[d]) / m;
        mass *= m;
      }
      if (blocks[node](i, i) > 0.0) scale_(i, node) = std::sqrt(own * mass / blocks[node](i, i));
    });
}

void FastDiagonal::to_modes(const Component& component, Vector& values) const {
  Eigen::Index inner = 1;
  for (const Direction& direction : component.directions) {
    multiply_along(direction.modes, inner, values, work_);
    values.swap(work_);
    inner *= direction.count();
  }
}

void FastDiagonal::from_modes(const Component& component, Vector& values) const {
  Eigen::Index inner = 1;
  for (const Direction& direction : component.directions) {
    multiply_along(direction.modes.transpose(), inner, values, work_);
    values.swap(work_);
    inner *= direction.count();
  }
}

void FastDiagonal::apply(const NodalVectors& r, NodalVectors& z) const {
  z.setZero(3, r.cols());
  for (int i = 0; i < 3; ++i) {
    const Component& component = components_[i];
    values_.resize(component.inverse.size());
    if (values_.size() == 0) continue;
    for_each_node(component, [&](Eigen::Index node, Eigen::Index place) {
      values_[place] = scale_(i, node) * r(i, node);
    });
    to_modes(component, values_);
    values_ = values_.cwiseProduct(component.inverse);
    from_modes(component, values_);
    for_each_node(component, [&](Eigen::Index node, Eigen::Index place) {
      z(i, node) = scale_(i, node) * values_[place];
    });
  }
  supports_.apply(z);
}

}  // namespace structure
