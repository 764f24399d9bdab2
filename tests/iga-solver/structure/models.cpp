// SPDX-License-Identifier: GPL-2.0-or-later
#include "models.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "nurbs/primitives.h"
#include "nurbs/refinement.h"
#include "structure/material/plate_material.h"
#include "structure/time/explicit_solver.h"

template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&, int);

namespace models {

using nurbs::KnotVector;

std::shared_ptr<const structure::Material> elastic(double E, double nu, double density) {
  return std::make_shared<structure::LinearElastic>(E, nu, density);
}

std::shared_ptr<const structure::Material> make_law(const structure::MaterialLaw& law, double E, double nu,
                                                    double density) {
  if (law.directions.empty()) return law.make({E, nu, density});
  return law.make(
      {E, 0.6 * E, 0.4 * E, nu, 0.25, 0.2, 0.3 * E, 0.25 * E, 0.2 * E, density, 1, 2, 3, 0, 1, -1});
}

std::vector<std::shared_ptr<const structure::Material>> large_strain_laws(double E) {
  std::vector<std::shared_ptr<const structure::Material>> laws;
  for (const structure::MaterialLaw& law : structure::material_laws())
    if (law.word != std::string("linear_elastic")) laws.push_back(make_law(law, E));
  laws.push_back(structure::with_plate_shear(structure::SaintVenantKirchhoff(E, 0.3, 1.0), {1, 2, 3}));
  return laws;
}

nurbs::Volume block(const Vector3& size, const std::array<int, 3>& elements,
                    const std::array<int, 3>& degrees) {
  return nurbs::box(
      Vector3::Zero(), size,
      {KnotVector::uniform(degrees[0], elements[0]), KnotVector::uniform(degrees[1], elements[1]),
       KnotVector::uniform(degrees[2], elements[2])});
}

nurbs::Volume block(const Vector3& size, const std::array<int, 3>& elements, int degree) {
  return block(size, elements, {degree, degree, degree});
}

nurbs::Volume distorted(nurbs::Volume patch, double amount) {
  patch.control_points += amount * random_vectors(patch.space.control_point_count(), 7);
  return patch;
}

nurbs::Volume quarter_ring(int degree, int elements) {
  const KnotVector line(1, {0, 0, 1, 1}), arc(2, {0, 0, 0, 1, 1, 1});
  const double corner = std::sqrt(0.5);
  NodalVectors X(3, 12);
  std::vector<double> weights;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 2; ++i) {
        const double r = 1.0 + i;
        X.col(i + 2 * (j + 3 * k)) = Vector3(j < 2 ? r : 0.0, j > 0 ? r : 0.0, k);
        weights.push_back(j == 1 ? corner : 1.0);
      }
  nurbs::Volume ring{nurbs::Space<3>({line, arc, line}, weights), X};
  for (int d = 0; d < 3; ++d) {
    if (degree > ring.space.degree(d)) ring = nurbs::elevate_degree(ring, d, degree - ring.space.degree(d));
    for (int i = 1; i < elements; ++i) ring = nurbs::insert_knot(ring, d, double(i) / elements);
  }
  return ring;
}

NodalVectors random_vectors(int nodes, unsigned seed) {
  std::mt19937 generator(seed);
  NodalVectors v(3, nodes);
  for (double& value : v.reshaped()) value = 2.0 * generator() / double(std::mt19937::max()) - 1.0;
  return v;
}

NodalVectors linear_field(const Matrix3& H, const NodalVectors& X) { return H * X; }

Matrix3 some_gradient() {
  Matrix3 H;
  H << 0.3, -0.7, 0.2, 0.5, -0.4, 0.9, -0.6, 0.1, 0.8;
  return H;
}

Eigen::MatrixXd stiffness(const structure::Body& body) {
  const int n = body.node_count();
  Eigen::MatrixXd K(3 * n, 3 * n);
  NodalVectors u = NodalVectors::Zero(3, n), f(u);
  for (int dof = 0; dof < 3 * n; ++dof) {
    u.data()[dof] = 1.0;
    body.internal_force(u, f);
    K.col(dof) = f.reshaped();
    u.data()[dof] = 0.0;
  }
  return K;
}

Eigen::MatrixXd mass_scaled_stiffness(const structure::Body& body, const structure::Supports& supports) {
  std::vector<int> free;
  for (int dof = 0; dof < 3 * body.node_count(); ++dof)
    if (!std::binary_search(supports.fixed_dofs().begin(), supports.fixed_dofs().end(), dof))
      free.push_back(dof);
  Eigen::VectorXd scale(free.size());
  for (std::size_t i = 0; i < free.size(); ++i) scale[i] = 1.0 / std::sqrt(body.row_sum_mass()[free[i] / 3]);
  return scale.asDiagonal() * stiffness(body)(free, free) * scale.asDiagonal();
}

NodalVectors no_forces(const structure::ExplicitSolver& solver) {
  return NodalVectors::Zero(3, solver.body().node_count());
}

void set_displacements(structure::ExplicitSolver& solver, const NodalVectors& u) {
  std::vector<double> state = solver.save();
  std::copy_n(u.data(), u.size(), state.begin() + 1);
  solver.load(state);
}

void step(structure::ExplicitSolver& solver, const NodalVectors& F) {
  solver.begin_step();
  solver.end_step(F);
}

std::vector<int> interior_nodes(const nurbs::Space<3>& space) {
  std::vector<int> nodes;
  const int n[3] = {space.control_point_count(0), space.control_point_count(1), space.control_point_count(2)};
  for (int k = 1; k < n[2] - 1; ++k)
    for (int j = 1; j < n[1] - 1; ++j)
      for (int i = 1; i < n[0] - 1; ++i) nodes.push_back(i + n[0] * (j + n[1] * k));
  return nodes;
}

}  // namespace models
