// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/solid/solid.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "nurbs/assert.h"
#include "nurbs/gauss_legendre.h"
#include "nurbs/memory.h"

namespace structure {

namespace {

constexpr int kMaxElementValues = 3 * padded(nurbs::RationalBasis<3>::kMaxFunctions);

/// dX/dxi from reference control points: J(i, d) = sum_A X_A,i dR_A/dxi_d.
Matrix3 jacobian(const nurbs::RationalBasis<3>& basis, const NodalVectors& X) {
  Matrix3 J = Matrix3::Zero();
  for (int a = 0; a < basis.count; ++a)
    for (int d = 0; d < 3; ++d) J.col(d) += basis.dR[d][a] * X.col(basis.control_point[a]);
  return J;
}

/// Gauss points of one direction in one span.
nurbs::QuadratureRule rule_of(const nurbs::Space<3>& space, int direction, int span) {
  const std::vector<double>& breaks = space.knots(direction).breaks();
  return nurbs::gauss_legendre(space.degree(direction) + 1, breaks[span], breaks[span + 1]);
}

[[noreturn]] void throw_not_positive(double det_J, int element, const std::array<int, 3>& span) {
  throw std::invalid_argument(fmt::format(
      "Solid: Jacobian determinant {} in element {} (spans {}, {}, {} of xi, eta, zeta), expected > 0: "
      "the patch is left-handed or folded there",
      det_J, element, span[0], span[1], span[2]));
}

}  // namespace

Solid::Solid(nurbs::Volume patch, std::shared_ptr<const Material> material)
    : patch_(std::move(patch)), material_(std::move(material)) {
  nurbs::check_patch(patch_);
  const nurbs::Space<3>& space = patch_.space;
  const std::size_t elements = space.element_count();
  functions_ = points_ =
      space.functions_per_element();  // degree + 1 points per direction: as many as functions
  padded_ = padded(functions_);
  remembered_ = std::size_t(points_) * material_->state_size();
  nurbs::expect_memory(sizeof(double) * ((3.0 * points_ + 1.0) * padded_ + 2.0 * remembered_) * elements,
                       fmt::format("a solid of {} elements of degrees {}, {}, {}", elements, space.degree(0),
                                   space.degree(1), space.degree(2)));
  nodes_.resize(elements * functions_);
  dR_dX_.assign(elements * points_ * 3 * padded_, 0.0);
  wJ_.resize(elements * points_);
  element_mass_.assign(elements * padded_, 0.0);
  row_sum_mass_ = Eigen::VectorXd::Zero(node_count());
  force_kernel_ = force_kernel(padded_);
  memory_.assign(elements * remembered_, 0.0);
  next_memory_ = memory_;
  for (int e = 0; e < space.element_count(); ++e) integrate_element(e);
}

void Solid::integrate_element(int element) {
  const nurbs::Space<3>& space = patch_.space;
  const std::array<int, 3> span = space.element_indices(element);
  nurbs::QuadratureRule rule[3];
  for (int d = 0; d < 3; ++d) rule[d] = rule_of(space, d, span[d]);
  int* nodes = &nodes_[std::size_t(element) * functions_];
  space.element_control_points(element, nodes);
  int point = 0;
  for (std::size_t k = 0; k < rule[2].points.size(); ++k)
    for (std::size_t j = 0; j < rule[1].points.size(); ++j)
      for (std::size_t i = 0; i < rule[0].points.size(); ++i)
        integrate_point(element, point++, {rule[0].points[i], rule[1].points[j], rule[2].points[k]},
                        rule[0].weights[i] * rule[1].weights[j] * rule[2].weights[k]);
  for (int a = 0; a < functions_; ++a) row_sum_mass_[nodes[a]] += element_mass(element)[a];
}

void Solid::integrate_point(int element, int point, const nurbs::Parameter<3>& xi, double weight) {
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate_on_element(patch_.space, element, xi, 1, basis);
  const Matrix3 J = jacobian(basis, patch_.control_points);
  const double det_J = J.determinant();
  if (!(det_J > 0.0)) throw_not_positive(det_J, element, patch_.space.element_indices(element));

  const std::size_t index = std::size_t(element) * points_ + point;
  const double wJ = wJ_[index] = weight * det_J;
  double* dR_dX = &dR_dX_[index * 3 * padded_];
  double* mass = &element_mass_[std::size_t(element) * padded_];
  const Matrix3 J_inverse_transposed = J.inverse().transpose();
  for (int a = 0; a < functions_; ++a) {
    const Vector3 gradient = J_inverse_transposed * Vector3(basis.dR[0][a], basis.dR[1][a], basis.dR[2][a]);
    for (int d = 0; d < 3; ++d) dR_dX[d * padded_ + a] = gradient[d];
    mass[a] += material_->density() * basis.R[a] * wJ;
  }
}

ElementGeometry Solid::geometry(int element) const {
  NURBS_ASSERT(0 <= element && element < patch_.space.element_count(), element);
  const std::size_t first_point = std::size_t(element) * points_;
  return {&dR_dX_[first_point * 3 * padded_], &wJ_[first_point], points_, padded_};
}

nurbs::BoundarySurface Solid::skin(const SkinPiece& piece) const {
  if (piece.patch != 0)
    throw std::invalid_argument(fmt::format("Solid: skin of patch {}, expected 0: it has one", piece.patch));
  return nurbs::boundary_surface(patch_.space, piece.face);
}

std::string Solid::describe_element(int element) const {
  const nurbs::Space<3>& space = patch_.space;
  const std::array<int, 3> spans = space.element_indices(element);
  return fmt::format("element {} (spans {}, {}, {} of xi, eta, zeta, undeformed about {})", element, spans[0],
                     spans[1], spans[2],
                     text(nurbs::interpolate(space, patch_.control_points, space.element_centre(element))));
}

double Solid::volume() const { return std::accumulate(wJ_.begin(), wJ_.end(), 0.0); }

void Solid::gather(int element, const NodalVectors& nodal, double* values) const {
  NURBS_ASSERT(nodal.cols() == node_count(), nodal.cols(), node_count());
  const int* nodes = element_nodes(element);
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < functions_; ++a) values[i * padded_ + a] = nodal(i, nodes[a]);
    std::fill(values + i * padded_ + functions_, values + (i + 1) * padded_, 0.0);
  }
}

ElementMemory Solid::held_memory(int element) const { return {memory_.data() + element * remembered_}; }

void Solid::set_memory(std::vector<double> memory) {
  if (memory.size() != memory_.size())
    throw std::invalid_argument(
        fmt::format("Solid: memory of {} numbers, expected {}", memory.size(), memory_.size()));
  memory_ = std::move(memory);
}

void Solid::element_force(int element, const double* u, double* f) const {
  force_kernel_(*material_, geometry(element), held_memory(element), u, f);
}

double Solid::smallest_volume_ratio(int element, const double* u) const {
  return structure::smallest_volume_ratio(geometry(element), u);
}

template <class ElementForce>
void Solid::assemble(const NodalVectors& u, NodalVectors& f, ElementForce element_force) const {
  NURBS_ASSERT(u.cols() == node_count() && f.cols() == node_count(), u.cols(), f.cols(), node_count());
  double u_element[kMaxElementValues], f_element[kMaxElementValues];
  f.setZero();
  for (int e = 0; e < patch_.space.element_count(); ++e) {
    gather(e, u, u_element);
    element_force(e, u_element, f_element);
    const int* nodes = element_nodes(e);
    for (int a = 0; a < functions_; ++a)
      for (int i = 0; i < 3; ++i) f(i, nodes[a]) += f_element[i * padded_ + a];
  }
}

void Solid::internal_force(const NodalVectors& u, NodalVectors& f) const {
  assemble(u, f, [this](int e, const double* u_e, double* f_e) { element_force(e, u_e, f_e); });
}

void Solid::evolve(const NodalVectors& u, double dt, NodalVectors& f) {
  if (remembered_ == 0) return internal_force(u, f);
  assemble(u, f, [&](int e, const double* u_e, double* f_e) {
    ElementMemory memory = held_memory(e);
    memory.next = next_memory_.data() + e * remembered_;
    memory.dt = dt;
    force_kernel_(*material_, geometry(e), memory, u_e, f_e);
  });
}

double Solid::strain_energy(const NodalVectors& u) const {
  double u_element[kMaxElementValues];
  double energy = 0.0;
  for (int e = 0; e < patch_.space.element_count(); ++e) {
    gather(e, u, u_element);
    energy += element_energy(*material_, geometry(e), held_memory(e).state, u_element);
  }
  return energy;
}

Matrix3 Solid::displacement_gradient(const NodalVectors& u, const nurbs::Parameter<3>& xi) const {
  nurbs::RationalBasis<3> basis;
  nurbs::evaluate(patch_.space, xi, 1, basis);
  return jacobian(basis, u) * jacobian(basis, patch_.control_points).inverse();
}

Matrix3 Solid::stress(const NodalVectors& u, const nurbs::Parameter<3>& xi) const {
  return material_->stress(displacement_gradient(u, xi),
                           memory_.data() + nearest_point(xi) * material_->state_size());
}

/// Quadrature point, counted through all elements, that is nearest in parameters.
std::size_t Solid::nearest_point(const nurbs::Parameter<3>& xi) const {
  const nurbs::Space<3>& space = patch_.space;
  const int element = space.element_at(xi);
  const std::array<int, 3> span = space.element_indices(element);
  std::size_t point = 0;
  for (int d = 2; d >= 0; --d) {
    const std::vector<double> points = rule_of(space, d, span[d]).points;
    const auto nearest = std::min_element(points.begin(), points.end(), [&](double a, double b) {
      return std::abs(a - xi[d]) < std::abs(b - xi[d]);
    });
    point = point * points.size() + (nearest - points.begin());
  }
  return std::size_t(element) * points_ + point;
}

}  // namespace structure
