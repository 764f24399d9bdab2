// SPDX-License-Identifier: GPL-2.0-or-later
// Small models that several tests share.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <memory>
#include <vector>

#include "nurbs/patch.h"
#include "structure/conditions/supports.h"
#include "structure/material/laws.h"
#include "structure/solid/solid.h"

// Dense eigenvalues, which tests compare with, take a compiler ten seconds: in models.cpp, once.
extern template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&, int);

namespace structure {
class ExplicitSolver;
}

namespace models {

using nurbs::NodalVectors;
using nurbs::Vector3;
using structure::Matrix3;

std::shared_ptr<const structure::Material> elastic(double E = 1.0, double nu = 0.3, double density = 1.0);

/// The constants of an isotropic law; of an orthotropic one others of that size, in axes of their own.
std::shared_ptr<const structure::Material> make_law(const structure::MaterialLaw& law, double E = 1.0,
                                                    double nu = 0.3, double density = 1.0);
/// All that model files may name but the small-strain one, and one in a plate.
std::vector<std::shared_ptr<const structure::Material>> large_strain_laws(double E = 1.0);

/// Axis-parallel block with its lowest corner at the origin.
nurbs::Volume block(const Vector3& size, const std::array<int, 3>& elements,
                    const std::array<int, 3>& degrees);
nurbs::Volume block(const Vector3& size, const std::array<int, 3>& elements, int degree);
/// Every control point moved by up to `amount` in each direction; the same in every run.
nurbs::Volume distorted(nurbs::Volume patch, double amount);
/// Quarter ring a = 1, b = 2, H = 1 of degree p = 2 or 3 with n^3 elements: radius, angle, height.  Rational.
nurbs::Volume quarter_ring(int degree, int elements);

/// Pseudo-random entries in [-1, 1].
NodalVectors random_vectors(int nodes, unsigned seed);
/// u_A = H X_A.
NodalVectors linear_field(const Matrix3& H, const NodalVectors& X);
/// A displacement gradient without any symmetry.
Matrix3 some_gradient();

/// Dense stiffness matrix, one internal force per column.
Eigen::MatrixXd stiffness(const structure::Body& body);
/// M^-1/2 K M^-1/2 without the fixed dofs, M lumped by row sums.
Eigen::MatrixXd mass_scaled_stiffness(const structure::Body& body, const structure::Supports& supports);
NodalVectors no_forces(const structure::ExplicitSolver& solver);
void set_displacements(structure::ExplicitSolver& solver, const NodalVectors& u);
/// One step under nodal forces.
void step(structure::ExplicitSolver& solver, const NodalVectors& F);
/// Control points on no face.
std::vector<int> interior_nodes(const nurbs::Space<3>& space);

}  // namespace models
